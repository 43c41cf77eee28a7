#pragma once
/// @file A smooth curve through surveyed points.

#include <vector>

#include "core/geometry/curve.h"

namespace voussoir {

/// The natural cubic spline through the points, its parameter the length of their chords. Precondition: at
/// least three points, no two in sequence alike.
Curve spline_through(const std::vector<Point>& points);

}  // namespace voussoir
