#pragma once
/// @file Whether bridges rest where they were found.
///
/// Newton's method finds equilibria that friction only just holds: the least disturbance makes joints slide
/// until others hold. Of seed 5000 of the random bridges, whose joints are stiffer along than across, one in
/// three with scattered joints is so, and moves by 0.1 to 0.2 mm when it cools by a hundredth of a kelvin, or
/// any block goes. No real bridge stays there for a night.

#include <span>
#include <vector>

#include "core/statics/quasi_static_solver.h"

namespace voussoir {

/// The solutions of these tasks, those of intact bridges without mortar after they have cooled and warmed by
/// a tenth of a kelvin: where one jumps on the way (StageTask), it rests where it ends, by what it has slid.
/// All others stay as they are.
std::vector<Solution> settle(std::span<const StageTask> tasks, std::vector<Solution> solutions,
                             const StageSolver& newton);

}  // namespace voussoir
