#pragma once
/// @file Semicircles and segments of circles.

#include "core/geometry/curve.h"

namespace voussoir {

/// The arc that reaches `half_angle` [rad] to both sides of the highest point of a circle.
Curve circular_arc(const Point& centre, double radius, double half_angle);

/// The arc of this span and rise [m] between two springings of equal height, `middle` between them.
/// Precondition: 0 < rise <= span / 2, where it is a semicircle.
Curve segment_of_circle(const Point& middle, double span, double rise);

}  // namespace voussoir
