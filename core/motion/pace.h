#pragma once
/// @file How fast time goes on: blocks that need short steps take several of them in each step of the others.
///
/// The stable step of a block goes with the root of its mass over its joints' stiffness. A few small pieces
/// beside the ring would have the whole bridge take a third of the steps that its other blocks need. They
/// alone do; where they meet the others, these go on as they moved in the last step, and what the contact
/// does to them is the mean over the short steps: action and reaction have equal impulses.

#include <vector>

#include "core/motion/critical_step.h"

namespace voussoir {

struct Pace {
  double step = 0.0;          ///< dt [s]
  int parts = 1;              ///< steps of a quick block in each
  std::vector<bool> quick{};  ///< of each block; empty: none is

  double quick_step() const { return step / parts; }
  bool is_quick(std::size_t block) const { return !quick.empty() && quick[block]; }
};

/// The pace of implicit steps at which contacts are looked at least often per time, with at most so many
/// parts. `critical` [s]: the critical step of all blocks; quick ones take at most this share of it, and
/// the others at most the same share of theirs.
Pace best_pace(const Model& model, const std::vector<BlockBody>& bodies, double contact_damping,
               double critical, double share, int most_parts);

}  // namespace voussoir
