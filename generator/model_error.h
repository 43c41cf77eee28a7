#pragma once
/// @file How far a bridge's own signals are off: what a finer mesh changes of them.

#include "database/records/model_error.h"
#include "database/records/record.h"
#include "generator/scene_solving.h"
#include "generator/state_plan.h"

namespace voussoir {

/// What a mesh one level finer changes is this part of the whole error. Measured on the reference bridge, 41
/// singles: the first two levels change a signal by 0.43 and 0.46 % (median) each, and an independent
/// program's finest mesh by 1.45 % (docs/numerics.md).
inline constexpr double kErrorPerLevel = 3.0;

struct ErrorProbes {
  const BridgeDescription& description;
  const Model& bridge;      ///< of that description
  const StatePlan& states;  ///< those that are kept are estimated
  const SolverChoice& solver;
};

/// Solves the intact bridge and some standing singles, evenly spread, on a mesh one level finer and compares
/// their signals with those of this mesh. One value for each kept state; zero where nothing can be compared
/// because the bridge does not stand.
std::vector<ModelError> estimate_model_errors(const ErrorProbes& probes);

}  // namespace voussoir
