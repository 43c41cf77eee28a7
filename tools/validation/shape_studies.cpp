/// @file Known answers of arches that are no semicircles.

#include <fmt/format.h>

#include <numbers>

#include "core/structure/top_surface.h"
#include "tools/validation/bisection.h"
#include "tools/validation/joint_limits.h"
#include "tools/validation/rigid_ring.h"
#include "tools/validation/snap_through.h"
#include "tools/validation/studies.h"
#include "tools/validation/trial_arches.h"

namespace voussoir::validation {
namespace {

const std::vector<double> kStiffnesses = {1e9, 1e10, 1e11};  ///< [Pa/m] those of the semicircle
constexpr double kThicknessStep = 1e-6;

using SpanOfThickness = std::function<SpanDescription(double thickness)>;

double least_rigid_thickness(const SpanOfThickness& span) {
  return first_true(1e-4, 0.4, 1e-7,
                    [&](double thickness) { return symmetric_arch_stands(rigid(span(thickness))); });
}

Case thickness_case(const std::string& name, const SpanOfThickness& span) {
  const double expected = least_rigid_thickness(span);
  const Limit limit = find_limit(kStiffForThinRings, [&](double stiffness) {
    return continued_down(3.0 * expected + 0.05, 0.1 * expected, kThicknessStep,
                          [&](double thickness) { return elastic(span(thickness), stiffness); });
  });
  Case found{.name = name,
             .quantity = "least t/R that stands, extrapolated to rigid joints",
             .expected = expected,
             .source = "statics of rigid voussoirs",
             .computed = limit.rigid};
  return absolute_case(found, limit.spread + 5e-5, kExtrapolation);
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
  for (const double beyond : {0.2, 0.5})
    findings.cases.push_back(
        thickness_case(fmt::format("Pointed arch, centres {} R past the axis, 16 voussoirs", beyond),
                       [=](double thickness) { return pointed(beyond, thickness, 16); }));
  return findings;
}

/// A segmental ring with a vertical force on the middle of a voussoir's extrados.
struct LoadedRing {
  SpanDescription span = segmental(std::numbers::pi / 3.0, 0.12, 13);
  RigidArch arch = rigid(span);
  int loaded = 0;

  Point place() const {
    const Polygon& voussoir = arch.voussoirs[static_cast<std::size_t>(loaded)];
    return 0.5 * (voussoir[0] + voussoir[3]);
  }
  std::string name() const {
    return fmt::format("Segmental arch of twice 60 degrees, t/R = 0.12, force on voussoir {} of 13",
                       loaded + 1);
  }
  double rigid_force() const { return weakest_mechanism(arch, loaded, place()).value_or(Mechanism{}).load; }
  double snap_through(double stiffness) const {
    return snap_through_force(arch, loaded, place(), {stiffness / kSpecificWeight, kHighFriction});
  }
};

/// What the solver finds that the ring bears, if that is about as much as expected.
double greatest_force(const LoadedRing& ring, double stiffness, double expected) {
  const Model bridge = elastic(ring.span, stiffness);
  Field start;
  return last_true(0.0, 2.0 * expected, 1e-5 * expected, [&](double force) {
    Field load = Field::Zero(2, bridge.mesh.node_count());
    TopSurface(bridge.mesh).add_force(kArchCentre + ring.place().x(), force * kSpecificWeight, load);
    return newton_stands(bridge, start, load);
  });
}

Case force_case(int loaded) {
  const LoadedRing ring{.loaded = loaded};
  const double expected = ring.rigid_force();
  const Limit limit =
      find_limit(kStiffnesses, [&](double stiffness) { return greatest_force(ring, stiffness, expected); });
  return absolute_case({.name = ring.name(),
                        .quantity = "greatest force over rho g R^2, extrapolated to rigid joints",
                        .expected = expected,
                        .source = "mechanism method: the weakest of all choices of four hinges",
                        .computed = limit.rigid},
                       limit.spread + 1e-4 * expected, kExtrapolation);
}

/// On the keystone what joints give decides, at any stiffness that joints have: the crown snaps through.
/// So the solver is held against rigid voussoirs on the same joints, and these against the mechanism.
void add_keystone_cases(Findings& findings) {
  const LoadedRing ring{.loaded = 6};
  for (const double stiffness : kStiffnesses) {
    const double expected = ring.snap_through(stiffness);
    findings.cases.push_back(relative_case(
        {.name = ring.name(),
         .quantity = fmt::format("greatest force over rho g R^2, p_n = {:.0e}", stiffness),
         .expected = expected,
         .source = "rigid voussoirs on elastic joints in the deformed geometry, lowered step by step",
         .computed = greatest_force(ring, stiffness, expected)},
        2e-3,
        "blocks give at most 0.4 % of what joints give, and the force grows with about the fourth root of "
        "stiffness"));
  }
  const Limit limit = find_limit({1e18, 1e19, 1e20}, [&](double p_n) { return ring.snap_through(p_n); });
  const double expected = ring.rigid_force();
  findings.cases.push_back(
      absolute_case({.name = "The same ring of rigid voussoirs on elastic joints, force on voussoir 7 of 13",
                     .quantity = "greatest force over rho g R^2, extrapolated to rigid joints",
                     .expected = expected,
                     .source = "mechanism method: the weakest of all choices of four hinges",
                     .computed = limit.rigid},
                    limit.spread + 1e-4 * expected, kExtrapolation));
}

Findings arch_under_point_load() {
  Findings findings;
  for (const int loaded : {2, 3, 4}) findings.cases.push_back(force_case(loaded));
  add_keystone_cases(findings);
  findings.notes = {
      "A rigid ring bears forty times as much on its keystone as at a quarter of its span. Joints of 1e11 "
      "Pa/m leave 13 % of that, of 1e14 Pa/m half: the crown snaps through. That is of the symmetric ring: "
      "it can sway aside from 0.4 % less on (1e11 Pa/m)."};
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
           .run = arch_under_point_load}};
}

}  // namespace voussoir::validation
