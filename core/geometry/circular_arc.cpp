#include "core/geometry/circular_arc.h"

#include <cmath>
#include <numbers>

namespace voussoir {

Curve circular_arc(const Point& centre, double radius, double half_angle) {
  const double first = 0.5 * std::numbers::pi - half_angle;
  const double whole = 2.0 * half_angle;
  return with_mirror_image(
      centre.x(), radius * whole, [=, y = centre.y()](const CurvePlace& place, double offset) -> Point {
        const double angle = first + whole * place.part / place.parts;
        return {(radius + offset) * std::cos(angle), y + (radius + offset) * std::sin(angle)};
      });
}

Curve segment_of_circle(const Point& middle, double span, double rise) {
  const double half = 0.5 * span;
  const double radius = 0.5 * (half * half / rise + rise);
  return circular_arc(middle + Point(0.0, rise - radius), radius, 2.0 * std::atan(rise / half));
}

}  // namespace voussoir
