#include "core/geometry/ellipse.h"

#include <cmath>
#include <numbers>

namespace voussoir {
namespace {

constexpr double kQuarter = 0.5 * std::numbers::pi;

/// Length from the springing to the angle phi, where the point is (a cos phi, b sin phi) [m].
double length_to(double phi, double a, double b) {
  if (a == b) return a * phi;
  if (b > a) return b * std::ellint_2(std::sqrt(1.0 - (a / b) * (a / b)), phi);
  const double modulus = std::sqrt(1.0 - (b / a) * (b / a));
  return a * (std::comp_ellint_2(modulus) - std::ellint_2(modulus, kQuarter - phi));
}

/// The angle at a length from the springing, by bisection: the length grows with it.
double angle_at(double length, double a, double b) {
  double low = 0.0, high = kQuarter;
  for (double middle = 0.5 * high; low < middle && middle < high; middle = 0.5 * (low + high))
    (length_to(middle, a, b) < length ? low : high) = middle;
  return high;
}

}  // namespace

Curve half_ellipse(const Point& middle, double span, double rise) {
  const double a = 0.5 * span, b = rise;
  const double half = length_to(kQuarter, a, b);
  return with_mirror_image(middle.x(), 2.0 * half,
                           [=, y = middle.y()](const CurvePlace& place, double offset) -> Point {
                             const bool at_end = place.part == 0.0;
                             const bool on_top = 2.0 * place.part == place.parts;
                             const double length = 2.0 * half * place.part / place.parts;
                             const double phi = at_end ? 0.0 : on_top ? kQuarter : angle_at(length, a, b);
                             const double cosine = on_top ? 0.0 : std::cos(phi), sine = std::sin(phi);
                             const Point normal = Point(b * cosine, a * sine).normalized();
                             return Point(a * cosine, y + b * sine) + offset * normal;
                           });
}

}  // namespace voussoir
