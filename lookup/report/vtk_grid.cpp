#include "lookup/report/vtk_grid.h"

#include <fmt/format.h>

#include <iterator>

namespace voussoir {
namespace {

std::string data_array(std::string_view type, std::string_view name, int components,
                       const std::string& values) {
  return fmt::format(
      "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n{}</DataArray>\n",
      type, name, components, values);
}

std::string data_array(const VtkArray& array) {
  std::string values;
  for (std::size_t i = 0; i < array.values.size(); ++i) {
    const bool ends_tuple = (i + 1) % static_cast<std::size_t>(array.components) == 0;
    fmt::format_to(std::back_inserter(values), "{}{}", array.values[i], ends_tuple ? '\n' : ' ');
  }
  return data_array(array.whole_numbers ? "Int32" : "Float64", array.name, array.components, values);
}

std::string data_arrays(const std::vector<VtkArray>& arrays) {
  std::string text;
  for (const VtkArray& array : arrays) text += data_array(array);
  return text;
}

std::string points_of(const VtkGrid& grid) {
  std::string places;
  for (const Point& point : grid.points) places += fmt::format("{} {} 0\n", point.x(), point.y());
  return data_array("Float64", "points_m", 3, places);
}

std::string cells_of(const VtkGrid& grid) {
  std::string connectivity, offsets, types;
  std::size_t end = 0;
  for (const std::vector<int>& cell : grid.cells) {
    connectivity += fmt::format("{}\n", fmt::join(cell, " "));
    offsets += fmt::format("{}\n", end += cell.size());
    types += fmt::format("{}\n", static_cast<int>(grid.kind));
  }
  return data_array("Int32", "connectivity", 1, connectivity) + data_array("Int32", "offsets", 1, offsets) +
         data_array("UInt8", "types", 1, types);
}

}  // namespace

std::string to_vtu(const VtkGrid& grid) {
  return fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n"
      "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n"
      "<PointData>\n{}</PointData>\n<CellData>\n{}</CellData>\n"
      "<Points>\n{}</Points>\n<Cells>\n{}</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n",
      grid.points.size(), grid.cells.size(), data_arrays(grid.point_data), data_arrays(grid.cell_data),
      points_of(grid), cells_of(grid));
}

}  // namespace voussoir
