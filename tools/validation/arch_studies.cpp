/// @file Known answers of the semicircular arch.

#include <fmt/format.h>
#include <array>

#include "core/motion/dynamic_solver.h"
#include "tools/validation/assemblies.h"
#include "tools/validation/bisection.h"
#include "tools/validation/joint_limits.h"
#include "tools/validation/rigid_ring.h"
#include "tools/validation/studies.h"

namespace voussoir::validation {
namespace {

constexpr double kPublishedDigits = 5e-5;  ///< half a unit of the fourth digit
constexpr double kBisection = 1e-6;        ///< of t/R

const char* const kPublishedRing = "Cocchetti and Rizzi 2020; statics of rigid voussoirs gives the same";
const char* const kPublishedFriction = "Cocchetti and Rizzi 2020, Table 3";

struct Published {
  int voussoirs;
  double thickness;  ///< over the mean radius
};
constexpr std::array<Published, 8> kPublished = {
    {{7, .0962}, {9, .1021}, {11, .1049}, {13, .1028}, {15, .1063}, {21, .1068}, {31, .1072}, {51, .1074}}};

/// Least t/R at which Newton's method finds an equilibrium; `high` if there is none up to it.
double least_thickness_by_newton(int voussoirs, double friction, double normal_stiffness, double high) {
  Field start;
  return first_true(0.05, high, kBisection, [&](double thickness) {
    return newton_stands(semicircular_ring(voussoirs, thickness, friction, normal_stiffness), start);
  });
}

Limit thickness_limit(int voussoirs, double friction, const std::vector<double>& stiffnesses, double high) {
  return find_limit(stiffnesses, [&](double stiffness) {
    return least_thickness_by_newton(voussoirs, friction, stiffness, high);
  });
}

Series series_of(const std::string& label, const Limit& limit) {
  Series series{.label = label};
  for (std::size_t i = 0; i < limit.roots.size(); ++i)
    series.points.emplace_back(limit.roots[i], limit.values[i]);
  series.points.emplace_back(0.0, limit.rigid);
  return series;
}

Case statics_case(const Published& published) {
  return absolute_case(
      {.name = fmt::format("Semicircular arch, {} rigid voussoirs, high friction", published.voussoirs),
       .quantity = "least t/R, by statics",
       .expected = published.thickness,
       .source = "Cocchetti and Rizzi 2020",
       .computed = least_thickness(published.voussoirs, kHighFriction, VoussoirShape::curved).value_or(0.0)},
      kPublishedDigits, "four digits are published");
}

/// The statics that other cases lean on, against what is published.
Findings ring_statics() {
  Findings findings;
  constexpr int kMany = 1601;
  for (const Published& published : kPublished) findings.cases.push_back(statics_case(published));
  findings.cases.push_back(
      absolute_case({.name = "Semicircular arch, 1601 rigid voussoirs, high friction",
                     .quantity = "least t/R, by statics",
                     .expected = 0.1075,
                     .source = "Milankovitch, continuous arch",
                     .computed = least_thickness(kMany, kHighFriction, VoussoirShape::curved).value_or(0.0)},
                    kPublishedDigits, "four digits are published"));
  const auto stands = [](double mu) { return ring_stands(kMany, 0.6, mu, VoussoirShape::curved); };
  const double least_friction = first_true(0.2, 0.5, 1e-7, stands);
  findings.cases.push_back(absolute_case({.name = "Semicircular arch, 1601 rigid voussoirs",
                                          .quantity = "friction below which no thickness stands, by statics",
                                          .expected = 0.3092,
                                          .source = kPublishedFriction,
                                          .computed = least_friction},
                                         kPublishedDigits, "four digits are published"));
  findings.cases.push_back(absolute_case(
      {.name = "Semicircular arch, 1601 rigid voussoirs, weight on the mean line",
       .quantity = "least t/R at mu = 0.309216, by statics",
       .expected = 0.2006,
       .source = kPublishedFriction,
       .computed = least_thickness(kMany, 0.309216, VoussoirShape::weight_on_mean_line).value_or(0.0)},
      kPublishedDigits, "four digits are published"));
  findings.notes = {
      fmt::format("The published 0.2006 at mu = 0.3092 has the weight on the ring's mean line; with the "
                  "weight where it is, statics "
                  "gives {:.4f}.",
                  least_thickness(kMany, 0.309216, VoussoirShape::curved).value_or(0.0))};
  return findings;
}

Findings ring_thickness() {
  Findings findings;
  Plot plot{.title = "Semicircular arch, high friction: least thickness against the joints' compliance",
            .x_label = "(rho g R / p_n)^(1/3)",
            .y_label = "least t/R"};
  double cost = 0.0;
  for (const Published& published : kPublished) {
    const Limit limit = thickness_limit(published.voussoirs, kHighFriction, {1e9, 1e10, 1e11}, 0.25);
    findings.cases.push_back(absolute_case(
        {.name = fmt::format("Semicircular arch, {} voussoirs, high friction", published.voussoirs),
         .quantity = "least t/R that stands, extrapolated to rigid joints",
         .expected = published.thickness,
         .source = kPublishedRing,
         .computed = limit.rigid},
        limit.spread + kPublishedDigits, kExtrapolation));
    plot.series.push_back(series_of(fmt::format("{} voussoirs", published.voussoirs), limit));
    cost = (limit.values.front() - limit.rigid) / limit.roots.front();
  }
  findings.plots = {plot};
  findings.notes = {
      fmt::format("Finite joint stiffness makes a semicircular arch need about {:.2f} (rho g R / p_n)^(1/3) "
                  "more t/R than rigid "
                  "voussoirs do: {:.3f} at R = 3.75 m and p_n = 1e9 Pa/m.",
                  cost, cost * std::cbrt(3.75 * compliance(1e9)))};
  return findings;
}

constexpr int kFrictionRing = 31;

Case friction_case(double mu, const Limit& limit) {
  const double expected = least_thickness(kFrictionRing, mu, VoussoirShape::curved).value_or(0.0);
  return absolute_case(
      {.name = fmt::format("Semicircular arch, {} voussoirs, mu = {}", kFrictionRing, mu),
       .quantity = "least t/R that stands, extrapolated to rigid joints",
       .expected = expected,
       .source = "statics of rigid voussoirs, which gives the published ends of the mixed mode",
       .computed = limit.rigid},
      limit.spread + kPublishedDigits, kExtrapolation);
}

/// With less friction than any thickness can stand on.
HardCase slippery_ring(double normal_stiffness) {
  constexpr double kSlippery = 0.305;
  const double least = least_thickness_by_newton(kFrictionRing, kSlippery, normal_stiffness, 0.6);
  const bool none = least > 0.6 - 2.0 * kBisection;
  return {.sweep = "arch, mu = 0.305",
          .setting = fmt::format("p_n = {:.0e} Pa/m", normal_stiffness),
          .scene = "ring",
          .verdict = none ? "none stands" : fmt::format("t/R {:.3f}", least),
          .expected = "no t/R up to 0.6 stands: below mu = 0.3092 (published)",
          .correct = none};
}

Findings ring_friction() {
  Findings findings;
  Series computed{.label = "computed, extrapolated to rigid joints", .line = false};
  Series statics{.label = "statics of rigid voussoirs"};
  for (double mu = 0.3105; mu < 0.48; mu += 0.0025)
    if (const auto t = least_thickness(kFrictionRing, mu, VoussoirShape::curved))
      statics.points.emplace_back(mu, *t);
  for (const double mu : {0.45, 0.38, 0.35, 0.32}) {
    const Limit limit =
        thickness_limit(kFrictionRing, mu, {1e8, std::sqrt(1e17), 1e9, std::sqrt(1e19), 1e10}, 0.6);
    findings.cases.push_back(friction_case(mu, limit));
    computed.points.emplace_back(mu, limit.rigid);
  }
  for (const double stiffness : {1e8, 1e10, 1e12}) findings.hard_cases.push_back(slippery_ring(stiffness));
  findings.plots = {{.title = "Semicircular arch: least thickness against friction",
                     .x_label = "mu",
                     .y_label = "least t/R",
                     .series = {statics, computed}}};
  return findings;
}

/// Gravity so slow that the ring follows at rest.
DynamicSettings slow_gravity() {
  DynamicSettings settings;
  settings.ramp = 3.0;
  settings.moment = 3.2;
  settings.decision.earliest_decision = 3.2;
  settings.decision.latest_decision = 12.0;
  settings.decision.standing_unbalance = 1e-5;
  settings.decision.plain_unbalance = 1.0;
  settings.decision.collapsing_unbalance = 1e-2;
  return settings;
}

HardCase in_motion(double mu, double thickness, bool stands) {
  const Model ring = semicircular_ring(kFrictionRing, thickness, mu, 1e9);
  const DynamicSolution moved = DynamicSolver(ring, slow_gravity()).solve(Scene{});
  return {.sweep = "arch near its limit, motion",
          .setting = fmt::format("mu = {}, t/R = {:.4f}", mu, thickness),
          .scene = "ring",
          .verdict = std::string(to_string(moved.solution.outcome)),
          .expected = stands ? "standing: 4 % above Newton's limit" : "collapsed: 4 % below Newton's limit",
          .iterations = moved.solution.iterations,
          .correct = moved.solution.outcome == (stands ? Outcome::standing : Outcome::collapsed)};
}

Findings ring_in_motion() {
  Findings findings;
  for (const double mu : {0.5, 0.35}) {
    const double limit = least_thickness_by_newton(kFrictionRing, mu, 1e9, 0.3);
    findings.hard_cases.push_back(in_motion(mu, 0.96 * limit, false));
    findings.hard_cases.push_back(in_motion(mu, 1.04 * limit, true));
  }
  return findings;
}

}  // namespace

std::vector<Study> arch_studies() {
  return {
      {.name = "arch-statics", .title = "Semicircular arch: rigid voussoirs", .run = ring_statics},
      {.name = "arch-thickness",
       .title = "Semicircular arch: least thickness",
       .quick = false,
       .run = ring_thickness},
      {.name = "arch-friction", .title = "Semicircular arch: friction", .quick = false, .run = ring_friction},
      {.name = "arch-motion",
       .title = "Semicircular arch: Newton against motion",
       .quick = false,
       .run = ring_in_motion}};
}

}  // namespace voussoir::validation
