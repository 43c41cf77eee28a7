#pragma once
/// @file How far a bridge's own signals are off: what a finer mesh changes of them, and that nobody knows how
/// suddenly blocks were lost.

#include "core/solve/state_plan.h"
#include "database/records/model_error.h"
#include "database/records/record.h"
#include "generator/running/progress.h"
#include "generator/scenes/solvers.h"

namespace voussoir {

/// The whole error of a signal is this many times what a mesh one level finer changes of it. Measured on the
/// reference bridge, 41 singles: the first two levels change a signal by 0.43 and 0.46 % (median) each, and
/// an independent program's finest mesh by 1.45 %.
inline constexpr double kErrorPerLevel = 3.0;

/// What losing a block suddenly instead of slowly changes of its signal [-], as in ModelError. Measured on 23
/// wall singles of the reference bridge, each in units of its own mean square (`tools/validate loss-sudden`,
/// docs/numerics.md).
inline constexpr double kShareOfSuddenRelease = 0.071;
inline constexpr double kCommonOfSuddenRelease = 0.117;

/// What a sudden release adds to it, in squares.
ModelError with_sudden_release(ModelError error);

struct ErrorProbes {
  const BridgeDescription& description;
  const Model& bridge;      ///< of that description
  const StatePlan& states;  ///< those that are kept are estimated
  const SolverChoice& solver;
  std::vector<bool> intact_stands{};  ///< in each kept state, as far as is known; empty: nothing is known
};

/// Solves the intact bridge and some standing singles, evenly spread, on a mesh one level finer and compares
/// their signals with those of this mesh; for states that blocks were lost before, adds the squares of what a
/// sudden release changes. One value for each kept state; the mesh's is zero where nothing can be compared
/// because the intact bridge does not stand (a load may be too much for it) or is large.
std::vector<ModelError> estimate_model_errors(const ErrorProbes& probes, Progress& progress);

}  // namespace voussoir
