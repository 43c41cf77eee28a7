#pragma once
/// @file What a solver says of a scene.

#include <string_view>
#include <vector>

#include "core/law/state.h"
#include "core/structure/collapse.h"

namespace voussoir {

enum class Outcome : std::uint8_t {
  standing = 0,   ///< equilibrium was reached
  collapsed = 1,  ///< blocks fall; the field is a snapshot at a stated moment
  unresolved = 2  ///< neither could be shown; the residual says how far it got
};

/// "standing", "collapsed", "unresolved"
std::string_view to_string(Outcome outcome);

/// Where an outcome comes from.
enum class Origin : std::uint8_t {
  solved = 0,    ///< its own equilibrium or motion was followed, or its fall proved
  composed = 1,  ///< from solutions of scenes with fewer missing blocks, after a check
  inherited = 2  ///< collapsed, as a scene does that misses some of the same blocks; no field (NaN)
};

/// "solved", "composed", "inherited"
std::string_view to_string(Origin origin);

/// A state, and how it came about. The memory is that of standing scenes; empty otherwise.
struct Solution : State {
  Outcome outcome = Outcome::unresolved;
  double residual =
      0.0;  ///< of equilibrium: largest unbalanced nodal force over the largest nodal weight [-]; of
            ///< a collapse in motion: sum of the blocks' resultant forces over the bridge's weight [-]
  int iterations = 0;  ///< linear systems solved; time steps for a collapse in motion
  CollapseExtent extent = CollapseExtent::none;  ///< of what `moving` says
  Origin origin = Origin::solved;
  std::vector<BlockId>
      moving{};  ///< blocks that had moved away when the scene's collapse was decided, ascending;
                 ///< of a scene in motion that stands those that slid and were caught
  Eigen::Matrix2Xd slipped{};  ///< of a stage that stands: plastic slip at the ends of the joints that its
                               ///< last step begins with [m], as motion has slid them or, in a later stage,
                               ///< a jump (StageTask); empty: none, or what the stage before has left
  std::vector<State> steps{};  ///< at the ends of all implicit steps but the last, if the task asked for them
};

inline bool stands(const Solution& solution) {
  return solution.outcome == Outcome::standing;
}

/// Has anything slipped when the solution's last step begins, beyond what the stage before has left?
inline bool has_slipped(const Solution& solution) {
  return solution.slipped.size() > 0;
}

}  // namespace voussoir
