#pragma once
/// @file Scenes that sensors cannot tell apart.

#include <span>
#include <vector>

#include "database/records/scene_table.h"
#include "lookup/readings/observation.h"

namespace voussoir {

/// Those of `others` whose predictions at the readings are the same as this row's, if errors are as large as
/// these scales and the model's own errors let expect of it. The row itself is left out.
std::vector<std::size_t> same_readings(const Observation& observation, const ErrorScales& scales,
                                       const SceneTable& table, std::size_t row,
                                       std::span<const std::size_t> others);

}  // namespace voussoir
