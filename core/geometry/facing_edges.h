#pragma once
/// @file Where two straight edges run against each other.

#include <array>
#include <optional>

#include "core/geometry/polygon.h"

namespace voussoir {

struct Edge {
  Point from;
  Point to;
};

/// A stretch that two edges share, by its begin and end along the first edge; places on an edge are shares of
/// its length from `from` to `to`.
struct FacingStretch {
  std::array<double, 2> on_first;
  std::array<double, 2> on_second;
  double length;  ///< [m]
};

/// The stretch in which two edges of opposite direction lie within `tolerance` [m] of each other; nothing if
/// it is shorter than that.
std::optional<FacingStretch> facing_stretch(const Edge& first, const Edge& second, double tolerance);

}  // namespace voussoir
