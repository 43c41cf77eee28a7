#include "tools/validation/trial_arches.h"

#include <cmath>

#include "core/geometry/arc_chain.h"
#include "core/structure/arch.h"

namespace voussoir::validation {
namespace {

constexpr double kFooting = 0.1;  ///< [m] of the stones below the springings

}  // namespace

/// The segment of a ring of mean radius 1 m that reaches `half_angle` to both sides of the crown.
SpanDescription segmental(double half_angle, double thickness, int voussoirs) {
  const double inner = 1.0 - 0.5 * thickness;
  SpanDescription span{
      .centre_x = kArchCentre, .centre_y = kFooting, .ring_thickness = thickness, .voussoirs = voussoirs};
  span.shape = IntradosShape::segmental;
  span.span = 2.0 * inner * std::sin(half_angle);
  span.rise = inner * (1.0 - std::cos(half_angle));
  return span;
}

/// Two arcs of mean radius 1 m with their centres `beyond` [m] past the axis, on the springing line.
SpanDescription pointed(double beyond, double thickness, int voussoirs) {
  const double inner = 1.0 - 0.5 * thickness;
  SpanDescription span{
      .centre_x = kArchCentre, .centre_y = kFooting, .ring_thickness = thickness, .voussoirs = voussoirs};
  span.shape = IntradosShape::pointed;
  span.span = 2.0 * (inner - beyond);
  span.rise = std::sqrt(inner * inner - beyond * beyond);
  span.arc_radius = inner;
  return span;
}

/// The voussoirs alone, rigid, about x = 0.
RigidArch rigid(const SpanDescription& span) {
  const Curve curve = intrados_of(span);
  const Point shift(kArchCentre, 0.0);
  RigidArch arch;
  for (int j = 0; j <= span.voussoirs; ++j) {
    const CurvePlace place{static_cast<double>(j), static_cast<double>(span.voussoirs)};
    arch.joints.push_back({curve.point(place, 0.0) - shift, curve.point(place, span.ring_thickness) - shift});
  }
  for (const Block& block : make_arch(span, true).blocks) {
    if (block.kind == BlockKind::leg) continue;
    Polygon& polygon = arch.voussoirs.emplace_back(block.polygon);
    for (Point& p : polygon) p -= shift;
  }
  return arch;
}

/// The same with elastic joints, on clamped stones.
Model elastic(const SpanDescription& span, double normal_stiffness) {
  BridgeDescription description;
  description.wall = {.length = 2.0 * kArchCentre, .courses = 0};
  description.spans = {span};
  description.supports.sides = SupportKind::free;
  description.material.young_modulus = 100.0 * normal_stiffness;
  description.joints = {.normal_stiffness = normal_stiffness,
                        .tangential_stiffness = normal_stiffness,
                        .friction_angle = std::atan(kHighFriction)};
  description.mesh.split_at_corners = false;
  return make_model(description);
}

}  // namespace voussoir::validation
