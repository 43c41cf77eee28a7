#pragma once
/// @file Are a database's sensitivities those of its fields?

#include "core/solve/state_plan.h"
#include "database/records/database.h"

namespace voussoir {

/// How many scenes have their sensitivities found anew.
inline constexpr std::size_t kCheckedSensitivities = 4;

/// Largest difference, relative to the scene's largest sensitivity, that is taken for none.
inline constexpr double kSameSensitivity = 1e-6;

struct SensitivityCheck {
  std::size_t scenes = 0;  ///< found anew, evenly spread
  std::vector<std::string> problems;
};

/// Finds the factors of some scenes anew from the stored fields. A database without sensitivities or without
/// fields has none to check, nor has one that does not keep the state `built`.
SensitivityCheck check_sensitivities(const Database& database, const Model& bridge,
                                     const BridgeDescription& description, const StatePlan& plan);

}  // namespace voussoir
