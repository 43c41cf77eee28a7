#pragma once
/// @file A curve from left to right by its length, and the curves parallel to it: the intrados of an arch.

#include <functional>

#include "core/geometry/polygon.h"

namespace voussoir {

/// A place on a curve: after `part` of `parts` equal parts of its length, from the left end.
struct CurvePlace {
  double part = 0.0;
  double parts = 1.0;

  double share() const { return part / parts; }
};

/// A curve as a value. Every family of curves has a file of its own, whose function makes one.
struct Curve {
  double length = 0.0;  ///< [m]
  /// The point [m] at a place, moved by `offset` [m] along the normal, to the outer (upper) side.
  std::function<Point(const CurvePlace& place, double offset)> point;
  bool has_corner = false;  ///< the direction jumps in the middle; the normal there halves the corner
};

/// The left half of a curve that is its own mirror image: x is the distance from the axis. Asked for places
/// in the left half only.
using HalfCurve = std::function<Point(const CurvePlace& place, double offset)>;

/// The half and its image across x = `axis` [m], so written that images are exact.
Curve with_mirror_image(double axis, double length, HalfCurve half);

}  // namespace voussoir
