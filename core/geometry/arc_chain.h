#pragma once
/// @file Curves of several circular arcs: pointed (two centres) and three-centred.

#include "core/geometry/curve.h"

namespace voussoir {

/// Two arcs of `radius` [m] that meet in a point over the middle of the springings, `rise` above them. With
/// pointed_radius the centres lie on the springing line; with a larger one below it. Precondition: the arcs
/// rise up to their meeting.
Curve pointed_arch(const Point& middle, double span, double rise, double radius);

/// [m] of the arcs whose centres lie on the springing line. At least half the span if rise >= span / 2.
double pointed_radius(double span, double rise);

/// Do arcs of this radius reach from springing to point, rising all the way?
bool is_pointed(double span, double rise, double radius);

/// A flat arc between two of `haunch_radius` [m], with one tangent where they meet; the haunches spring
/// upright. Precondition: 0 < haunch_radius < rise < span / 2.
Curve three_centred_arch(const Point& middle, double span, double rise, double haunch_radius);

/// The haunch radius with which the two radii differ least (as a ratio).
double roundest_haunch_radius(double span, double rise);

}  // namespace voussoir
