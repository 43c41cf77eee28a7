#include "tools/validation/trial_arches.h"

#include <cmath>

#include "core/structure/arch.h"

namespace voussoir::validation {

SpanDescription segmental(double half_angle, double thickness, int voussoirs) {
  const double inner = 1.0 - 0.5 * thickness;
  SpanDescription span{
      .centre_x = kArchCentre, .centre_y = kFooting, .ring_thickness = thickness, .voussoirs = voussoirs};
  span.shape = IntradosShape::segmental;
  span.span = 2.0 * inner * std::sin(half_angle);
  span.rise = inner * (1.0 - std::cos(half_angle));
  return span;
}

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

Model elastic(const SpanDescription& span, double normal_stiffness) {
  BridgeDescription description = arch_description(normal_stiffness, kHighFriction);
  description.spans = {span};
  return make_model(description);
}

}  // namespace voussoir::validation
