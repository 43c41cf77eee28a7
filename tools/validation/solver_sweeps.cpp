/// @file Hard cases: time steps, starting guesses, number formats.

#include <random>

#include "core/error.h"
#include "core/motion/dynamic_solver.h"
#include "core/statics/quasi_static_solver.h"
#include "tools/validation/hard_case_runs.h"
#include "tools/validation/studies.h"

namespace voussoir::validation {
namespace {

constexpr const char* kScene = "4,2";

DynamicSolution moved(const Model& bridge, double step) {
  DynamicSettings settings;
  settings.step = step;
  settings.decision.standing_unbalance = 1e-7;
  settings.decision.latest_decision = 3.0;
  return DynamicSolver(bridge, settings).solve(parse_scene(kScene, bridge.layout));
}

HardCase step_case(const Model& bridge, double share, double critical, const Eigen::VectorXd& tightest) {
  HardCase row{.sweep = "time step", .setting = fmt::format("{:g} of the critical", share), .scene = kScene};
  try {
    const DynamicSolution solution = moved(bridge, share * critical);
    row.verdict = std::string(to_string(solution.solution.outcome));
    row.error =
        relative_difference(readings_at(bridge.control_points, solution.solution.displacement), tightest);
    row.iterations = solution.solution.iterations;
  } catch (const InputError&) {
    row.verdict = "refused";
  }
  row.expected =
      share <= 1.0 ? "standing, d within 1 % of that of a tenth of the step" : "refused: not stable";
  row.correct = share <= 1.0 ? row.verdict == "standing" && *row.error < 0.01 : row.verdict == "refused";
  return row;
}

/// Friction remembers the way, and the way depends a little on the step: 1 %.
Findings time_steps() {
  Findings findings;
  const Model bridge = make_model(small_bridge());
  const double critical = DynamicSolver(bridge).critical_step();
  const Eigen::VectorXd tightest =
      readings_at(bridge.control_points, moved(bridge, 0.05 * critical).solution.displacement);
  for (const double share : {0.1, 0.3, 0.9, 0.99, 1.0, 1.01, 2.0, 100.0})
    findings.hard_cases.push_back(step_case(bridge, share, critical, tightest));
  return findings;
}

/// Starts that no sensible caller would give.
std::vector<std::pair<std::string, Field>> bad_starts(const Model& bridge, const Field& answer) {
  const auto nodes = bridge.mesh.node_count();
  std::mt19937 random(9);
  std::normal_distribution<double> normal;
  const Field noise = Field::NullaryExpr(2, nodes, [&] { return normal(random); });
  const Field clean = answer.array().isNaN().select(0.0, answer);
  const double infinity = std::numeric_limits<double>::infinity();
  return {{"noise of 1e-6 m", 1e-6 * noise},
          {"noise of 1 mm", 1e-3 * noise},
          {"noise of 1 m", noise},
          {"noise of 1e6 m", 1e6 * noise},
          {"lifted by 1 m", Field::Constant(2, nodes, 1.0)},
          {"the answer times -1", -clean},
          {"the answer times 1000", 1e3 * clean},
          {"not a number", Field::Constant(2, nodes, std::nan(""))},
          {"infinite", Field::Constant(2, nodes, infinity)},
          {"1e300 m", Field::Constant(2, nodes, 1e300)}};
}

Findings starting_guesses() {
  Findings findings;
  const Model bridge = make_model(small_bridge());
  const Scene scene = parse_scene(kScene, bridge.layout);
  QuasiStaticSolver solver(bridge);
  const Field answer = solver.solve(scene).displacement;
  for (const auto& [name, start] : bad_starts(bridge, answer)) {
    const Solution solution = solver.solve(scene, start);
    HardCase row{.sweep = "starting guess",
                 .setting = name,
                 .scene = kScene,
                 .verdict = std::string(to_string(solution.outcome)),
                 .expected = "standing, as from rest within 1e-6",
                 .error = relative_difference(readings_at(bridge.control_points, solution.displacement),
                                              readings_at(bridge.control_points, answer)),
                 .iterations = solution.iterations};
    row.correct = solution.outcome == Outcome::standing && *row.error < 1e-6;
    findings.hard_cases.push_back(row);
  }
  return findings;
}

/// Fields kept with fewer digits: what is left of the signal.
Findings single_precision() {
  Findings findings;
  for (const bool reference : {false, true}) {
    const Model bridge = make_model(reference ? BridgeDescription{} : small_bridge());
    const std::string name = reference ? "10,4" : kScene;
    QuasiStaticSolver solver(bridge);
    const Eigen::VectorXd intact = readings_at(bridge.control_points, solver.solve(Scene{}).displacement);
    const Eigen::VectorXd damaged =
        readings_at(bridge.control_points, solver.solve(parse_scene(name, bridge.layout)).displacement);
    const Eigen::VectorXd rounded =
        damaged.cast<float>().cast<double>() - intact.cast<float>().cast<double>();
    HardCase row{.sweep = "single precision storage",
                 .setting = reference ? "reference bridge" : "small bridge",
                 .scene = name,
                 .verdict = "stored",
                 .expected = "signal within 1e-4: d has 7 digits, the signal is a hundredth of it or more",
                 .error = relative_difference(rounded, damaged - intact)};
    row.correct = *row.error < 1e-4;
    findings.hard_cases.push_back(row);
  }
  return findings;
}

}  // namespace

std::vector<Study> solver_sweeps() {
  return {{.name = "sweep-steps",
           .title = "Time steps up to and past the limit",
           .quick = false,
           .run = time_steps},
          {.name = "sweep-starts", .title = "Starting guesses far off", .run = starting_guesses},
          {.name = "sweep-storage", .title = "Single precision", .run = single_precision}};
}

}  // namespace voussoir::validation
