#pragma once
/// @file A support that moves: a foot that settles or turns, a side that is pushed.

#include "core/structure/structure.h"

namespace voussoir {

/// Displacements [m], 2 x nodes, of a support that moves and turns (counter-clockwise, small) as a rigid body
/// about the middle of its nodes; zero elsewhere, and in directions that it does not hold or an earlier one
/// does.
Field rigid_movement(const Structure& structure, std::size_t support, const Point& movement, double rotation);

}  // namespace voussoir
