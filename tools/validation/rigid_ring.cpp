#include "tools/validation/rigid_ring.h"

#include <cmath>
#include <numbers>

#include "core/geometry/polygon.h"
#include "tools/validation/bisection.h"

namespace voussoir::validation {
namespace {

constexpr double kThickest = 0.6;
constexpr double kBisectionWidth = 1e-7;  ///< of the bisection

/// Weight of unit specific weight, and its first moment about the vertical through the centre.
struct Weight {
  double size;
  double moment;
};

/// Of the ring (mean radius 1) between two angles from the left springing.
Weight weight_between(double from, double to, double thickness, VoussoirShape shape) {
  const double inner = 1.0 - 0.5 * thickness;
  const double outer = 1.0 + 0.5 * thickness;
  if (shape == VoussoirShape::weight_on_mean_line)
    return {thickness * (to - from), thickness * (std::sin(from) - std::sin(to))};
  if (shape == VoussoirShape::curved)
    return {0.5 * (to - from) * (outer * outer - inner * inner),
            (outer * outer * outer - inner * inner * inner) / 3.0 * (std::sin(from) - std::sin(to))};
  const auto at = [](double radius, double angle) {
    return Point(-radius * std::cos(angle), radius * std::sin(angle));
  };
  const Polygon block = {at(outer, from), at(outer, to), at(inner, to), at(inner, from)};
  const double size = std::abs(area(block));
  return {size, size * centroid(block).x()};
}

/// The part of a voussoir on the left of the crown; the keystone of an odd number is cut in two.
Weight weight_of_voussoir(int j, int voussoirs, double thickness, VoussoirShape shape) {
  const double angle = std::numbers::pi / voussoirs;
  const double crown = 0.5 * std::numbers::pi;
  if ((j + 1) * angle <= crown + 1e-12) return weight_between(j * angle, (j + 1) * angle, thickness, shape);
  if (shape != VoussoirShape::straight) return weight_between(j * angle, crown, thickness, shape);
  const double flat = std::cos(0.5 * angle);  // the middle of a chord lies this share of the radius out
  const double inner = 1.0 - 0.5 * thickness;
  const double outer = 1.0 + 0.5 * thickness;
  const Point at(-std::cos(j * angle), std::sin(j * angle));
  const Polygon half = {outer * at, {0.0, outer * flat}, {0.0, inner * flat}, inner * at};
  const double size = std::abs(area(half));
  return {size, size * centroid(half).x()};
}

}  // namespace

bool ring_stands(int voussoirs, double thickness, double friction, VoussoirShape shape) {
  // Unknowns (H, M): thrust at the crown and its moment about the centre of the ring.
  Polygon possible = {{0.0, -10.0}, {10.0, -10.0}, {10.0, 10.0}, {0.0, 10.0}};
  Weight above{0.0, 0.0};
  for (int j = (voussoirs - 1) / 2; j >= 0 && !possible.empty(); --j) {
    const Weight next = weight_of_voussoir(j, voussoirs, thickness, shape);
    above = {above.size + next.size, above.moment + next.moment};
    const double angle = std::numbers::pi * j / voussoirs;
    const double s = std::sin(angle);
    const double c = std::cos(angle);
    // Normal force N = H s + W c, shear force T = -H c + W s, moment -(M - W's moment): N at radius r has
    // moment -r N.
    for (const double side : {1.0, -1.0}) {
      const double radius = 1.0 + side * 0.5 * thickness;
      possible =
          clipped(possible, side * Point(-radius * s, 1.0), side * (above.moment + radius * above.size * c));
      possible = clipped(possible, {-side * c - friction * s, 0.0},
                         friction * above.size * c - side * above.size * s);
    }
  }
  return !possible.empty();
}

std::optional<double> least_thickness(int voussoirs, double friction, VoussoirShape shape) {
  if (!ring_stands(voussoirs, kThickest, friction, shape)) return std::nullopt;
  return first_true(0.0, kThickest, kBisectionWidth,
                    [&](double thickness) { return ring_stands(voussoirs, thickness, friction, shape); });
}

}  // namespace voussoir::validation
