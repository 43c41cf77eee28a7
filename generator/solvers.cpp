#include <fmt/format.h>

#include <charconv>
#include <memory>
#include <sstream>

#include "core/error.h"
#include "core/solve/combined_solver.h"
#include "generator/scene_solving.h"

namespace voussoir {
namespace {

// The structured bindings fail to compile when settings gain a member, which then has to be added here.

std::string settings_text(const QuasiStaticSettings& settings) {
  const auto& [tolerance, round_off, loose_tolerance, most_warm_iterations, most_iterations,
               most_falling_iterations, follow_falls, collapse_displacement, joint_rule, skips] = settings;
  static_cast<void>(skips);  // stated with the motion's settings, which every solver has
  return fmt::format(
      "tolerance = {}\nround_off = {}\nloose_tolerance = {}\nmost_warm_iterations = {}\nmost_iterations = "
      "{}\n"
      "most_falling_iterations = {}\nfollow_falls = {}\ncollapse_displacement_m = {}\njoint_integration = "
      "{}\n",
      tolerance, round_off, loose_tolerance, most_warm_iterations, most_iterations, most_falling_iterations,
      follow_falls, collapse_displacement, to_string(joint_rule));
}

std::string or_automatic(const std::optional<double>& value) {
  return value ? fmt::format("{}", *value) : "automatic";
}

std::string settings_text(const DynamicSettings& settings) {
  const auto& [integrator, inertia, step, ramp, damping, contact_damping, moment, earliest_decision,
               latest_decision, standing_unbalance, collapsing_unbalance, plain_unbalance,
               largest_standing_unbalance, moving_sags, skips, side_by_side] = settings;
  static_cast<void>(side_by_side);  // like the other skips, it does not change the answer
  std::string text = fmt::format(
      "integrator = {}\ninertia = {}\nstep_s = {}\nramp_s = {}\ndamping_per_s = {}\ncontact_damping_s = "
      "{}\nmoment_s = "
      "{}\n",
      integrator == Integrator::implicit_blocks ? "implicit" : "explicit",
      inertia == RotationalInertia::exact ? "exact" : "lumped", or_automatic(step), ramp,
      or_automatic(damping), contact_damping, moment);
  text += fmt::format("earliest_decision_s = {}\nlatest_decision_s = {}\nstanding_unbalance = {}\n",
                      earliest_decision, latest_decision, standing_unbalance);
  text += fmt::format("collapsing_unbalance = {}\nplain_unbalance = {}\nlargest_standing_unbalance = {}\n",
                      collapsing_unbalance, plain_unbalance, largest_standing_unbalance);
  return text + fmt::format("moving_sags = {}\nearly_outcome = {}\n", moving_sags,
                            skips.early_outcome ? "used" : "not used");
}

/// The value of a "key = value" line; empty if there is none.
std::string value_of(std::string_view settings, const std::string& key) {
  std::istringstream lines{std::string(settings)};
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with(key + " = ")) return line.substr(key.size() + 3);
  return {};
}

/// What parse_build_options can change of the motion, read back from its settings_text.
DynamicSettings motion_in(std::string_view settings) {
  const auto number = [&](const char* key, double& value) {
    const std::string text = value_of(settings, key);
    std::from_chars(text.data(), text.data() + text.size(), value);
  };
  const auto optional_number = [&](const char* key, std::optional<double>& value) {
    if (value_of(settings, key) != "automatic") number(key, value.emplace());
  };
  DynamicSettings motion;
  if (value_of(settings, "integrator") == "explicit") motion.integrator = Integrator::central_differences;
  optional_number("step_s", motion.step);
  number("ramp_s", motion.ramp);
  optional_number("damping_per_s", motion.damping);
  number("latest_decision_s", motion.latest_decision);
  number("standing_unbalance", motion.standing_unbalance);
  motion.skips.early_outcome = value_of(settings, "early_outcome") == "used";
  return motion;
}

constexpr const char* kQuasiStatic = "solver = quasi-static\n";
constexpr const char* kDynamic = "solver = dynamic\n";

}  // namespace

SolverChoice quasi_static(const DynamicSettings& motion) {
  QuasiStaticSettings newton;
  newton.skips = motion.skips;
  return {kQuasiStatic + settings_text(newton) + settings_text(motion),
          [newton, motion](const Bridge& bridge) -> SceneSolver {
            const auto solver = std::make_shared<CombinedSolver>(bridge, newton, motion);
            return [solver](std::span<const SceneStart> scenes) { return solver->solve(scenes); };
          }};
}

SolverChoice dynamic(const DynamicSettings& motion) {
  return {kDynamic + settings_text(motion), [motion](const Bridge& bridge) -> SceneSolver {
            const auto solver = std::make_shared<DynamicSolver>(bridge, motion);
            return [solver](std::span<const SceneStart> tasks) {
              std::vector<Scene> scenes;
              for (const SceneStart& task : tasks) scenes.push_back(task.scene);
              std::vector<Solution> solutions;
              for (DynamicSolution& motion_of_scene : solver->solve(scenes))
                solutions.push_back(std::move(motion_of_scene.solution));
              return solutions;
            };
          }};
}

SolverChoice solver_with(std::string_view settings) {
  const DynamicSettings motion = motion_in(settings);
  for (SolverChoice choice : {quasi_static(motion), dynamic(motion)})
    if (settings.starts_with(choice.settings)) return choice;
  throw Failure("the database was built with solver settings that this program does not have");
}

}  // namespace voussoir
