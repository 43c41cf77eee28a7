#pragma once
/// @file Files of sensors, beside those that the database has.
///
/// A CSV table (csv_text.h, decimal_mark.h) with the columns `name`; `quantity`: ux, uy, tilt or distance;
/// the place `x_m,y_m`, and for a distance the other place `x2_m,y2_m`; and, where blocks meet at a place,
/// the block that carries the sensor there: `block`, `block2` (as in scenes: "10,4"). A tilt needs no place
/// if its block is named.
///
/// Signs: ux to the right, uy up, tilt counter-clockwise, distance longer.

#include <filesystem>
#include <string>
#include <string_view>

#include "lookup/readings/sensor.h"

namespace voussoir {

/// Appends the file's sensors to the list. Throws InputError "file:line: ..." for a name that is there
/// already, an unknown quantity, a place outside the bridge or where blocks meet and none is named, a
/// distance between places that are one, and numbers or places that the quantity does not have.
void parse_sensors(std::string_view text, const std::string& name, const BlockLayout& layout,
                   const Mesh& mesh, SensorList& list);
void read_sensors(const std::filesystem::path& path, const BlockLayout& layout, const Mesh& mesh,
                  SensorList& list);

}  // namespace voussoir
