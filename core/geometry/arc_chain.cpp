#include "core/geometry/arc_chain.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace voussoir {
namespace {

/// An arc of the left half. x is the distance to the left of the axis; angles rise from the horizontal.
struct Arc {
  Point centre;
  double radius;
  double first;  ///< [rad]
  double sweep;  ///< [rad]

  double length() const { return radius * sweep; }
  Point at(double distance, double offset) const {
    const double angle = first + distance / radius;
    return centre + (radius + offset) * Point(std::cos(angle), std::sin(angle));
  }
};

/// Where a circle crosses the axis.
Point on_axis(const Arc& arc, double offset) {
  const double radius = arc.radius + offset;
  return {0.0, arc.centre.y() + std::sqrt(radius * radius - arc.centre.x() * arc.centre.x())};
}

Curve chain(double axis, const std::vector<Arc>& arcs) {
  double half = 0.0;
  for (const Arc& arc : arcs) half += arc.length();
  return with_mirror_image(axis, 2.0 * half, [arcs, half](const CurvePlace& place, double offset) -> Point {
    if (2.0 * place.part == place.parts) return on_axis(arcs.back(), offset);
    double distance = 2.0 * half * place.part / place.parts;
    std::size_t i = 0;
    for (; i + 1 < arcs.size() && distance > arcs[i].length(); ++i) distance -= arcs[i].length();
    return arcs[i].at(distance, offset);
  });
}

/// The centre of the left arc of a pointed arch, seen from the middle of the springings (x to the left).
Point centre_of_left_arc(double span, double rise, double radius) {
  const Point springing(0.5 * span, 0.0), top(0.0, rise);
  const Point chord = top - springing;
  const Point inward = Point(-chord.y(), chord.x()).normalized();  // below the chord, to the right
  return 0.5 * (springing + top) + std::sqrt(radius * radius - 0.25 * chord.squaredNorm()) * inward;
}

}  // namespace

double pointed_radius(double span, double rise) {
  return 0.25 * span + rise * rise / span;
}

bool is_pointed(double span, double rise, double radius) {
  if (4.0 * radius * radius <= 0.25 * span * span + rise * rise) return false;
  const Point centre = centre_of_left_arc(span, rise, radius);
  return centre.x() < -1e-9 * span && centre.y() < rise;
}

Curve pointed_arch(const Point& middle, double span, double rise, double radius) {
  const Point centre = centre_of_left_arc(span, rise, radius);
  const double first = std::atan2(-centre.y(), 0.5 * span - centre.x());
  const double last = std::atan2(rise - centre.y(), -centre.x());
  Curve curve = chain(middle.x(), {{centre + Point(0.0, middle.y()), radius, first, last - first}});
  curve.has_corner = true;
  return curve;
}

double roundest_haunch_radius(double span, double rise) {
  const double half = 0.5 * span;
  return (half * half + rise * rise - (half - rise) * std::hypot(half, rise)) / (2.0 * half);
}

Curve three_centred_arch(const Point& middle, double span, double rise, double haunch_radius) {
  const double out = 0.5 * span - haunch_radius;  // of the haunch's centre from the axis
  const double above = rise - haunch_radius;
  const double below = (out * out - above * above) / (2.0 * above);  // of the flat arc's centre
  const double turn = std::atan2(below, out);
  return chain(middle.x(), {{{out, middle.y()}, haunch_radius, 0.0, turn},
                            {{0.0, middle.y() - below}, rise + below, turn, 0.5 * std::numbers::pi - turn}});
}

}  // namespace voussoir
