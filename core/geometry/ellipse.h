#pragma once
/// @file Half an ellipse.

#include "core/geometry/curve.h"

namespace voussoir {

/// The upper half of an ellipse with upright axes; `middle` of the springings is its centre. Its length is an
/// elliptic integral; parallel curves are offsets along the normal, no ellipses.
Curve half_ellipse(const Point& middle, double span, double rise);

}  // namespace voussoir
