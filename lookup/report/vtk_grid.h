#pragma once
/// @file Grids for ParaView: VTK's XML format of unstructured grids (VTU), as text.

#include <string>
#include <vector>

#include "core/geometry/polygon.h"

namespace voussoir {

enum class VtkCell { poly_line = 4, triangle = 5 };

/// Values of points or of cells, one after the other.
struct VtkArray {
  std::string name;    ///< with its unit
  int components = 1;  ///< values of each point or cell
  std::vector<double> values{};
  bool whole_numbers = false;
};

struct VtkGrid {
  std::vector<Point> points{};            ///< [m]
  std::vector<std::vector<int>> cells{};  ///< numbers of their points
  VtkCell kind = VtkCell::triangle;
  std::vector<VtkArray> point_data{};
  std::vector<VtkArray> cell_data{};
};

/// The file's text. NaN is written as it is; VTK reads it.
std::string to_vtu(const VtkGrid& grid);

}  // namespace voussoir
