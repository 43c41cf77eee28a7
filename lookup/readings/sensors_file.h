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
#include <optional>
#include <string>
#include <string_view>

#include "lookup/readings/sensor.h"

namespace voussoir {

/// The sensors of the list, and those of the file after them. Throws InputError "file:line: ..." for a name
/// that is there already, an unknown quantity, a place outside the bridge or where blocks meet and none is
/// named, a distance between places that are one, and numbers or places that the quantity does not have.
SensorList parse_sensors(std::string_view text, const std::string& name, const BlockLayout& layout,
                         const Mesh& mesh, SensorList list = {});
SensorList read_sensors(const std::filesystem::path& path, const BlockLayout& layout, const Mesh& mesh,
                        SensorList list = {});

/// A database's own sensors, and after them those of a file, if one is named.
SensorList all_sensors(const Database& database, const std::optional<std::filesystem::path>& file);

}  // namespace voussoir
