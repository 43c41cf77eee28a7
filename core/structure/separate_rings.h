#pragma once
/// @file Arches that are given as blocks under one ring number.

#include <vector>

#include "core/structure/block.h"

namespace voussoir {

/// Gives ring blocks of one number that do not hang together, touching within `tolerance` [m], numbers of
/// their own: the first group keeps the number, others get the next that are free, as their first blocks
/// come. So two surveyed arches without ring numbers are two rings, each with a middle of its own.
void separate_rings(double tolerance, std::vector<Block>& blocks);

}  // namespace voussoir
