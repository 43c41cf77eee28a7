#pragma once
/// @file Sensors that are shown in one chart.

#include <string>
#include <vector>

#include "lookup/report/pictured_answer.h"

namespace voussoir {

/// Sensors of one quantity under one load: those on top, those of the arch, or others. Stretches of a course
/// each have the next places on the axis and a free one between them, so that no line joins two courses.
struct PointSet {
  std::string title, id;  ///< with the sensors' names; of figures
  Quantity quantity = Quantity::uy;
  std::vector<std::size_t> points;  ///< from left to right, of walls course by course
  std::vector<double> places;       ///< of each on the axis, from 1
  std::vector<std::string> names;   ///< at every place of the axis, empty where it is free
};

/// Of heights on top, on the arch and elsewhere and of each other quantity under each load, as far as there
/// are such sensors with a reading; silent ones belong to the set, places without a sensor do not.
std::vector<PointSet> point_sets(const PicturedAnswer& report);

}  // namespace voussoir
