/// @file Hard cases: stiffness, friction, loads.

#include <fmt/format.h>
#include <numbers>

#include "tools/validation/hard_case_runs.h"
#include "tools/validation/studies.h"

namespace voussoir::validation {
namespace {

constexpr double kSignalTolerance =
    1e-4;  ///< build-database's solver against the tightest: far below the mesh's 1 %

using Change = std::function<void(BridgeDescription&)>;

void run_changed(const std::string& sweep, const std::string& value, const BridgeDescription& base,
                 const std::vector<Expectation>& scenes, const Change& change, Findings& findings) {
  BridgeDescription description = base;
  change(description);
  run_setting({.sweep = sweep, .value = value, .bridge = make_model(description), .scenes = scenes},
              kSignalTolerance, nullptr, findings);
}

/// Error of the signals and linear systems against the swept value.
Plot error_plot(const Findings& findings, const std::string& title, const std::string& x_label,
                const std::vector<double>& values) {
  Plot plot{.title = title,
            .x_label = x_label,
            .y_label = "error against the tightest run",
            .log_x = true,
            .log_y = true};
  for (const std::string scene : {"intact", "4,2"}) {
    Series series{.label = scene};
    std::size_t next = 0;
    for (const HardCase& row : findings.hard_cases)
      if (row.scene == scene && next < values.size()) {
        if (row.error && *row.error > 0.0) series.points.emplace_back(values[next], *row.error);
        ++next;
      }
    plot.series.push_back(series);
  }
  return plot;
}

Findings normal_stiffness() {
  Findings findings;
  const std::vector<double> values = {1e7, 1e8, 1e9, 1e10, 1e11, 1e12};
  for (const double value : values) {
    std::vector<Expectation> scenes = usual_scenes();
    if (value > 5e11) scenes.pop_back();  // steps of 10 microseconds: the collapse is a study of its own
    run_changed(
        "p_n, p_t = p_n / 10", fmt::format("{:.0e} Pa/m", value), small_bridge(), scenes,
        [&](BridgeDescription& d) {
          d.joints.normal_stiffness = value;
          d.joints.tangential_stiffness = 0.1 * value;
        },
        findings);
  }
  findings.plots = {error_plot(findings, "Joint stiffness: error of the signal", "p_n [Pa/m]", values)};
  return findings;
}

Findings stiffest_collapse() {
  Findings findings;
  run_changed(
      "p_n, p_t = p_n / 10", "1e+12 Pa/m", small_bridge(),
      {{"intact", Outcome::standing, "the reference setting stands"},
       {"0,5", Outcome::collapsed, "an arch without a voussoir"}},
      [](BridgeDescription& d) {
        d.joints.normal_stiffness = 1e12;
        d.joints.tangential_stiffness = 1e11;
      },
      findings);
  return findings;
}

Findings soft_reference() {
  Findings findings;
  for (const double value : {1e7, 1e8, 1e10, 1e11, 1e12})
    run_changed(
        "p_n, reference bridge", fmt::format("{:.0e} Pa/m", value), BridgeDescription{},
        {{"intact", Outcome::standing, "it stands with 1e9"},
         {"10,4", Outcome::standing, "it stands with 1e9"}},
        [&](BridgeDescription& d) {
          d.joints.normal_stiffness = value;
          d.joints.tangential_stiffness = 0.1 * value;
        },
        findings);
  return findings;
}

Findings stiffness_ratio() {
  Findings findings;
  for (const double value : {1e-3, 1e-2, 1e-1, 0.3, 1.0})
    run_changed(
        "p_t / p_n", fmt::format("{:g}", value), small_bridge(), usual_scenes(),
        [&](BridgeDescription& d) { d.joints.tangential_stiffness = value * d.joints.normal_stiffness; },
        findings);
  return findings;
}

/// Without (4,2) the half block above hangs on its neighbours by friction: it slides out when that is small.
std::vector<Expectation> scenes_at_friction(double degrees) {
  std::vector<Expectation> scenes = usual_scenes();
  scenes[0].because = "the smooth side walls hold the thrust";
  if (degrees < 15.0) scenes[1] = {"4,2", Outcome::collapsed, "too little friction holds the block above"};
  return scenes;
}

Findings friction() {
  Findings findings;
  for (const double degrees : {0.0, 1.0, 5.0, 10.0, 20.0, 30.0, 35.0, 45.0, 60.0})
    run_changed(
        "phi", fmt::format("{:g} deg", degrees), small_bridge(), scenes_at_friction(degrees),
        [&](BridgeDescription& d) { d.joints.friction_angle = degrees * std::numbers::pi / 180.0; },
        findings);
  return findings;
}

Findings elasticity() {
  Findings findings;
  const std::vector<double> values = {2.5e7, 2.5e8, 2.5e9, 2.5e10, 2.5e11, 2.5e12, 2.5e13};
  for (const double value : values)
    run_changed(
        "E", fmt::format("{:.1e} Pa", value), small_bridge(), usual_scenes(),
        [&](BridgeDescription& d) { d.material.young_modulus = value; }, findings);
  findings.plots = {error_plot(findings, "Block stiffness: error of the signal", "E [Pa]", values)};
  return findings;
}

Findings denormals() {
  Findings findings;
  for (const double value : {0.0, 1e-300, 1e-200, 1.0})
    run_changed(
        "gravity", fmt::format("{:g} m/s2", value), small_bridge(),
        {{"intact", Outcome::standing, "forces scale with gravity"},
         {"4,2", Outcome::standing, "forces scale with gravity"}},
        [&](BridgeDescription& d) { d.gravity = value; }, findings);
  for (const double value : {1e-300, 1e-100, 1e3})
    run_changed(
        "thickness", fmt::format("{:g} m", value), small_bridge(), usual_scenes(),
        [&](BridgeDescription& d) { d.material.thickness = value; }, findings);
  return findings;
}

}  // namespace

std::vector<Study> material_sweeps() {
  return {{.name = "sweep-pn",
           .title = "Sweep of the joints' normal stiffness",
           .quick = false,
           .run = normal_stiffness},
          {.name = "sweep-pn-collapse",
           .title = "Collapse with the stiffest joints",
           .quick = false,
           .run = stiffest_collapse},
          {.name = "sweep-pn-reference",
           .title = "The reference bridge with soft and stiff joints",
           .quick = false,
           .run = soft_reference},
          {.name = "sweep-pt", .title = "Sweep of the joints' tangential stiffness", .run = stiffness_ratio},
          {.name = "sweep-phi", .title = "Sweep of the friction angle", .run = friction},
          {.name = "sweep-e", .title = "Sweep of the blocks' stiffness", .run = elasticity},
          {.name = "sweep-denormal", .title = "Tiny loads", .run = denormals}};
}

}  // namespace voussoir::validation
