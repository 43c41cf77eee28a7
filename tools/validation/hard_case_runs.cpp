#include "tools/validation/hard_case_runs.h"

#include <fmt/format.h>

#include "core/bridge_file/bridge_file.h"
#include "core/solve/combined_solver.h"
#include "core/statics/equilibrium.h"

namespace voussoir::validation {
namespace {

constexpr double kUnbalanced = 1e-5;  ///< of a standing field, at most: QuasiStaticSettings::loose_tolerance

std::vector<Solution> solve_all(const Setting& setting) {
  std::vector<StageTask> starts;
  for (const Expectation& e : setting.scenes)
    starts.push_back({.stage = {.scene = parse_scene(e.scene, setting.bridge.layout)}});
  return CombinedSolver(setting.bridge).solve(starts);
}

/// From the field that was found, so that a hard search is not needed twice.
Signals polished_signals(const Setting& setting, const std::vector<Solution>& solutions) {
  QuasiStaticSolver solver(setting.bridge, tightest());
  Signals signals;
  for (std::size_t i = 0; i < solutions.size(); ++i) {
    const std::string& name = setting.scenes[i].scene;
    if (solutions[i].outcome == Outcome::standing)
      signals[name] = readings_at(setting.bridge.control_points,
                                  solver
                                      .solve({.stage = {.scene = parse_scene(name, setting.bridge.layout)},
                                              .start = &solutions[i].displacement})
                                      .displacement);
  }
  for (auto& [name, signal] : signals)
    if (name != "intact" && signals.contains("intact")) signal -= signals["intact"];
  return signals;
}

bool in_equilibrium(const Model& bridge, const std::string& scene, const Solution& solution) {
  const Scene removed = parse_scene(scene, bridge.layout);
  Eigen::Index gone = 0;
  for (const BlockId block : removed.removed)
    gone += 2 * bridge.mesh.block_nodes[static_cast<std::size_t>(value(block))].size();
  return solution.displacement.array().isNaN().count() == gone &&
         unbalanced_force(bridge, removed, solution.displacement) <= kUnbalanced;
}

}  // namespace

QuasiStaticSettings tightest() {
  QuasiStaticSettings settings;
  settings.tolerance = 1e-13;
  settings.round_off = 1e-14;
  return settings;
}

BridgeDescription small_bridge() {
  return read_bridge_file(VOUSSOIR_SOURCE_DIR "/examples/bridges/small.toml").description;
}

std::vector<Expectation> usual_scenes() {
  return {{"intact", Outcome::standing, "the reference setting stands"},
          {"4,2", Outcome::standing, "the reference setting stands"},
          {"0,5", Outcome::collapsed, "an arch without a voussoir"}};
}

double relative_difference(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  double distance = 0.0;
  double size = 0.0;
  for (Eigen::Index i = 0; i < a.size(); ++i) {
    if (std::isnan(a[i]) || std::isnan(b[i])) continue;
    distance += std::abs(a[i] - b[i]);
    size += std::abs(b[i]);
  }
  return size > 0.0 ? distance / size : distance;
}

Signals tightest_signals(const Model& bridge, const std::vector<Expectation>& scenes) {
  const Setting setting{.sweep = {}, .value = {}, .bridge = bridge, .scenes = scenes};
  return polished_signals(setting, solve_all(setting));
}

void run_setting(const Setting& setting, double tolerance, const Signals* reference, Findings& findings) {
  const std::vector<Solution> solutions = solve_all(setting);
  const Signals own = reference == nullptr ? polished_signals(setting, solutions) : Signals{};
  const Signals& expected = reference == nullptr ? own : *reference;
  for (std::size_t i = 0; i < solutions.size(); ++i) {
    const Expectation& expectation = setting.scenes[i];
    HardCase row{.sweep = setting.sweep,
                 .setting = setting.value,
                 .scene = expectation.scene,
                 .verdict = std::string(to_string(solutions[i].outcome)),
                 .expected = fmt::format("{}: {}", to_string(expectation.outcome), expectation.because),
                 .iterations = solutions[i].iterations};
    row.correct = solutions[i].outcome == expectation.outcome;
    if (solutions[i].outcome == Outcome::standing) {
      Eigen::VectorXd signal = readings_at(setting.bridge.control_points, solutions[i].displacement);
      if (i > 0) signal -= readings_at(setting.bridge.control_points, solutions[0].displacement);
      if (expected.contains(expectation.scene))
        row.error = relative_difference(signal, expected.at(expectation.scene));
      row.correct = row.correct && in_equilibrium(setting.bridge, expectation.scene, solutions[i]) &&
                    row.error && *row.error <= tolerance;
    }
    findings.hard_cases.push_back(row);
  }
}

}  // namespace voussoir::validation
