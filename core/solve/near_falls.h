#pragma once
/// @file Falls that show near the missing blocks, whatever the rest of the bridge does.
///
/// Most of what falls does so beside the missing blocks. So what has no equilibrium near its start is set in
/// motion in a patch around them first, of some fifteen blocks, whose rim goes where the start says: that
/// takes the same time whatever the size of the bridge. Only a fall is believed, and only one that goes
/// further than the whole bridge's would have to; what does not fall there is left to the whole bridge.
/// Measured on random bridges (docs/speed.md).

#include <optional>

#include "core/motion/dynamic_solver.h"
#include "core/statics/quasi_static_solver.h"

namespace voussoir {

/// A fall without a field, or nothing. Looked at are scenes as built that have a start; where the
/// patch is not much less than the bridge, none. `rules`: of motions of the whole bridge.
std::optional<Solution> fall_nearby(const StageTask& task, const DynamicSolver& motion,
                                    const DecisionRules& rules);

}  // namespace voussoir
