#pragma once
/// @file An arch: intrados, rings of voussoirs between its normals, and what it leaves free for the wall.

#include <vector>

#include "core/geometry/curve.h"
#include "core/structure/block.h"
#include "core/structure/bridge_description.h"

namespace voussoir {

/// The intrados of a span.
Curve intrados_of(const SpanDescription& span);

/// Number of its rings, and how thick they are together [m].
int ring_count(const SpanDescription& span);
double thickness_of_rings(const SpanDescription& span);

/// Does a stone carry each end of the ring? If the description does not say: semicircles have straight legs
/// to the ground, other shapes such stones where the wall has no courses that could carry them.
bool has_skewbacks(const SpanDescription& span, bool wall_has_courses);

/// The blocks of an arch. Curved edges are chords between the joints of the ring and of the rings that touch
/// it, so that neighbouring rings share their edges; joints are normal to the intrados.
struct Arch {
  std::vector<Block> blocks;  ///< innermost ring first with the stones below its ends; `ring` counts from 0
  Polygon enclosed;           ///< what no wall block may enter: rings, stones and the opening below [m]
};

/// Throws InputError naming the voussoir if one would be turned inside out: the rings are too thick for the
/// curve or the voussoirs too many.
Arch make_arch(const SpanDescription& span, bool wall_has_courses);

}  // namespace voussoir
