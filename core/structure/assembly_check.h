#pragma once
/// @file Blocks that were not laid by a rule: do they make an assembly?

#include <string>
#include <vector>

#include "core/structure/block.h"

namespace voussoir {

/// How near blocks have to be [m].
struct AssemblyTolerance {
  double heal = 1e-3;   ///< what is off by less is healed
  double joint = 1e-6;  ///< edges closer than this form a joint
};

/// Gaps up to so many times the tolerance of healing are taken for mistakes; wider ones are meant.
inline constexpr double kGapRange = 10.0;

/// Throws InputError that names two blocks and the place if they overlap by more than a strip of `tolerance`
/// [m] along the smaller one's outline.
void check_overlaps(const std::vector<Block>& blocks, double tolerance);

/// Makes an assembly of blocks: clockwise outlines are turned, corners that nearly meet are snapped, and the
/// notes say so. Throws InputError that names blocks and place for outlines that cross themselves, overlaps,
/// gaps, blocks that nothing carries, missing or repeated labels.
std::vector<std::string> heal_and_check(std::vector<Block>& blocks, const AssemblyTolerance& tolerance);

}  // namespace voussoir
