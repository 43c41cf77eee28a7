#pragma once
/// @file Blocks that were not laid by a rule: do they make an assembly?

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/structure/block.h"

namespace voussoir {

/// Pairs of blocks, by their numbers.
using BlockPairs = std::vector<std::pair<std::size_t, std::size_t>>;

/// The first block that is not held and from which no chain of pairs that touch leads to one that is.
std::optional<std::size_t> first_loose(const std::vector<bool>& held, const BlockPairs& touching);

/// How near blocks have to be [m].
struct AssemblyTolerance {
  double heal = 1e-3;   ///< what is off by less is healed
  double joint = 1e-6;  ///< edges closer than this form a joint
};

/// Gaps up to so many times the tolerance of healing are taken for mistakes; wider ones are meant.
inline constexpr double kGapRange = 10.0;

/// How blocks have to meet that were laid by rules, of which nothing is healed. Beside a ring, whose chords
/// run to courses at any angle, no gap is taken for a mistake.
struct LaidTolerance {
  double joint = 1e-6;  ///< [m] edges closer than this form a joint; overlaps are narrower
  double gap = 1e-2;    ///< [m] narrower gaps are taken for mistakes, wider ones are meant
};

/// Throws InputError that names blocks and place for overlaps by more than a strip along the smaller block's
/// outline, for gaps, and for blocks from which no chain of joints leads to a corner that `is_held`.
void check_laid(const std::vector<Block>& blocks, const LaidTolerance& tolerance,
                const std::function<bool(const Point&)>& is_held);

/// Throws InputError for blocks so long, or so far apart, that they must have been drawn in millimetres.
void expect_metres(const std::vector<Block>& blocks);

/// Makes an assembly of blocks: clockwise outlines are turned, corners that nearly meet are snapped, and the
/// notes say so. Throws InputError that names blocks and place for outlines that cross themselves, overlaps,
/// gaps, blocks that nothing carries, missing or repeated labels.
std::vector<std::string> heal_and_check(std::vector<Block>& blocks, const AssemblyTolerance& tolerance);

}  // namespace voussoir
