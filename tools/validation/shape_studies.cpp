/// @file Known answers of arches that are no semicircles.

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/geometry/arc_chain.h"
#include "core/structure/arch.h"
#include "core/structure/top_surface.h"
#include "tools/validation/bisection.h"
#include "tools/validation/joint_limits.h"
#include "tools/validation/rigid_arch.h"
#include "tools/validation/rigid_ring.h"
#include "tools/validation/studies.h"

namespace voussoir::validation {
namespace {

constexpr double kCentre = 50.0;  ///< [m]
constexpr double kFooting = 0.1;  ///< [m] of the stones below the springings
constexpr double kHighFriction = 2.0;
const std::vector<double> kStiffnesses = {1e9, 1e10, 1e11};  ///< [Pa/m] those of the semicircle
constexpr double kBisection = 1e-6;
constexpr double kSpecificWeight = 2400.0 * 9.81;  ///< [N/m3]

/// The segment of a ring of mean radius 1 m that reaches `half_angle` to both sides of the crown.
SpanDescription segmental(double half_angle, double thickness, int voussoirs) {
  const double inner = 1.0 - 0.5 * thickness;
  SpanDescription span{
      .centre_x = kCentre, .centre_y = kFooting, .ring_thickness = thickness, .voussoirs = voussoirs};
  span.shape = IntradosShape::segmental;
  span.span = 2.0 * inner * std::sin(half_angle);
  span.rise = inner * (1.0 - std::cos(half_angle));
  return span;
}

/// Two arcs of mean radius 1 m with their centres `beyond` [m] past the axis, on the springing line.
SpanDescription pointed(double beyond, double thickness, int voussoirs) {
  const double inner = 1.0 - 0.5 * thickness;
  SpanDescription span{
      .centre_x = kCentre, .centre_y = kFooting, .ring_thickness = thickness, .voussoirs = voussoirs};
  span.shape = IntradosShape::pointed;
  span.span = 2.0 * (inner - beyond);
  span.rise = std::sqrt(inner * inner - beyond * beyond);
  span.arc_radius = inner;
  return span;
}

/// The voussoirs alone, rigid, about x = 0.
RigidArch rigid(const SpanDescription& span) {
  const Curve curve = intrados_of(span);
  const Point shift(kCentre, 0.0);
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
  description.wall = {.length = 2.0 * kCentre, .courses = 0};
  description.spans = {span};
  description.supports.sides = SupportKind::free;
  description.material.young_modulus = 100.0 * normal_stiffness;
  description.joints = {.normal_stiffness = normal_stiffness,
                        .tangential_stiffness = normal_stiffness,
                        .friction_angle = std::atan(kHighFriction)};
  description.mesh.split_at_corners = false;
  return make_model(description);
}

using SpanOfThickness = std::function<SpanDescription(double thickness)>;

double least_rigid_thickness(const SpanOfThickness& span) {
  return first_true(1e-4, 0.4, 1e-7,
                    [&](double thickness) { return symmetric_arch_stands(rigid(span(thickness))); });
}

Case thickness_case(const std::string& name, const SpanOfThickness& span, bool judged = true) {
  const double expected = least_rigid_thickness(span);
  const Limit limit = find_limit(kStiffnesses, [&](double stiffness) {
    Field start;
    return first_true(0.2 * expected, 3.0 * expected + 0.05, kBisection, [&](double thickness) {
      return newton_stands(elastic(span(thickness), stiffness), start);
    });
  });
  Case found{.name = name,
             .quantity = "least t/R that stands, extrapolated to rigid joints",
             .expected = expected,
             .source = "statics of rigid voussoirs",
             .computed = limit.rigid};
  if (judged) return absolute_case(found, limit.spread + 5e-5, kExtrapolation);
  return comparison(found, fmt::format("the extrapolations differ by {:.1g} only", limit.spread));
}

/// The statics and the mechanisms on which the others lean, against each other and the semicircle's.
Findings shape_statics() {
  Findings findings;
  for (const int voussoirs : {9, 15, 31}) {
    const auto span = [&](double thickness) {
      return segmental(0.5 * std::numbers::pi, thickness, voussoirs);
    };
    findings.cases.push_back(absolute_case(
        {.name = fmt::format("Semicircle as a segment, {} straight-edged rigid voussoirs", voussoirs),
         .quantity = "least t/R, by statics of any symmetric arch",
         .expected = least_thickness(voussoirs, kHighFriction, VoussoirShape::straight).value_or(0.0),
         .source = "statics of semicircular rings",
         .computed = least_rigid_thickness(span)},
        1e-6, "both are found by halving to 1e-7"));
  }
  return findings;
}

Findings shape_thickness() {
  Findings findings;
  for (const double degrees : {45.0, 60.0, 75.0})
    findings.cases.push_back(thickness_case(
        fmt::format("Segmental arch of twice {} degrees, 15 voussoirs", degrees),
        [=](double thickness) { return segmental(degrees * std::numbers::pi / 180.0, thickness, 15); }));
  for (const auto& [beyond, judged] : {std::pair(0.2, true), std::pair(0.5, false)})
    findings.cases.push_back(thickness_case(
        fmt::format("Pointed arch, centres {} R past the axis, 16 voussoirs", beyond),
        [beyond = beyond](double thickness) { return pointed(beyond, thickness, 16); }, judged));
  findings.notes = {
      "The steep pointed arch (centres 0.5 R past the axis) needs 0.0397 R by extrapolation and 0.0387 R by "
      "statics: 0.0010 R apart, a quarter more than the extrapolations differ (0.0008 R). With 1e10 to 1e12 "
      "Pa/m "
      "they are 0.0004 R apart, but there Newton's method misses equilibria close to other limits. It is "
      "compared, "
      "not judged."};
  return findings;
}

/// The greatest force on the middle of a voussoir's extrados that a segmental ring bears.
Case force_case(int loaded, bool judged) {
  const SpanDescription span = segmental(std::numbers::pi / 3.0, 0.12, 13);
  const RigidArch arch = rigid(span);
  const Polygon& voussoir = arch.voussoirs[static_cast<std::size_t>(loaded)];
  const Point place = 0.5 * (voussoir[0] + voussoir[3]);
  const auto mechanism = weakest_mechanism(arch, loaded, place);
  const double expected = mechanism ? mechanism->load : 0.0;
  const Limit limit = find_limit(kStiffnesses, [&](double stiffness) {
    const Model ring = elastic(span, stiffness);
    Field start;
    return last_true(0.0, 2.0 * expected, 1e-5 * expected, [&](double force) {
      Field load = Field::Zero(2, ring.mesh.node_count());
      TopSurface(ring.mesh).add_force(kCentre + place.x(), force * kSpecificWeight, load);
      return newton_stands(ring, start, load);
    });
  });
  Case found{.name = fmt::format("Segmental arch of twice 60 degrees, t/R = 0.12, force on voussoir {} of 13",
                                 loaded + 1),
             .quantity = "greatest force over rho g R^2, extrapolated to rigid joints",
             .expected = expected,
             .source = "mechanism method: the weakest of all choices of four hinges",
             .computed = limit.rigid};
  if (judged) return absolute_case(found, limit.spread + 1e-4 * expected, kExtrapolation);
  return comparison(found, "joints of these stiffnesses let the crown snap through long before");
}

Findings point_load() {
  Findings findings;
  for (const int loaded : {2, 3, 4}) findings.cases.push_back(force_case(loaded, true));
  findings.cases.push_back(force_case(6, false));
  findings.notes = {
      "A rigid ring bears forty times as much on its keystone as at a quarter of its span. Elastic joints "
      "bear "
      "a force there that still grows with their stiffness at 1e11 Pa/m, so it is compared, not judged."};
  return findings;
}

}  // namespace

std::vector<Study> shape_studies() {
  return {{.name = "shape-statics", .title = "Arches of any shape: rigid voussoirs", .run = shape_statics},
          {.name = "shape-thickness",
           .title = "Segmental and pointed arches: least thickness",
           .quick = false,
           .run = shape_thickness},
          {.name = "shape-load",
           .title = "Segmental arch under a point load",
           .quick = false,
           .run = point_load}};
}

}  // namespace voussoir::validation
