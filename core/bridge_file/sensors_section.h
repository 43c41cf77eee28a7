#pragma once
/// @file Reading [[sensors]] of a bridge file.

#include <string>
#include <vector>

#include "core/bridge_file/toml_section.h"
#include "core/structure/sensor_description.h"

namespace voussoir {

inline constexpr std::size_t kMostSensors = 1000;

/// Throws InputError "file:line: message". Whether the places are on the bridge is found with its blocks.
std::vector<SensorDescription> read_sensors(const toml::array& tables, const std::string& file);

}  // namespace voussoir
