#pragma once
/// @file Joints that a motion of bounded steps can follow.
///
/// The stable step goes with the root of the lightest block's mass over its joints' stiffness: a piece of a
/// hundredth of a block, or joints a hundred times as stiff, make it ten times as short, and every scene that
/// falls ten times as long. What falls hardly feels it: joints hold blocks apart, and by how many micrometres
/// decides nothing. So in motion the joints of each block are made as soft as the step needs, both
/// stiffnesses by one factor, friction as it is. What such a motion shows of blocks at rest is the sag of the
/// softened bridge; scenes that stand are Newton's, with the joints as they are.

#include <vector>

#include "core/motion/block_dynamics.h"

namespace voussoir {

/// For each block the share of its joints' stiffness at which it alone, between neighbours that stand still,
/// allows this step [s]; at most 1.
std::vector<double> softening(const Model& model, const std::vector<BlockBody>& bodies,
                              double contact_damping, double step);

/// The model with every joint softened by the smaller share of its two blocks, and likewise what blocks meet
/// newly.
Model softened(Model model, const std::vector<double>& share_of_block);

}  // namespace voussoir
