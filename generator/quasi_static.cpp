#include <fmt/format.h>

#include <memory>

#include "generator/scene_solving.h"

namespace voussoir {
namespace {

/// The structured binding fails to compile when the settings gain a member, which then has to be added here.
std::string settings_text(const QuasiStaticSettings& settings) {
  const auto& [tolerance, round_off, loose_tolerance, most_warm_iterations, most_iterations,
               most_falling_iterations, collapse_displacement] = settings;
  std::string text = "solver = quasi-static\n";
  text += fmt::format("tolerance = {}\nround_off = {}\n", tolerance, round_off);
  text +=
      fmt::format("loose_tolerance = {}\nmost_warm_iterations = {}\n", loose_tolerance, most_warm_iterations);
  text += fmt::format("most_iterations = {}\nmost_falling_iterations = {}\n", most_iterations,
                      most_falling_iterations);
  return text + fmt::format("collapse_displacement_m = {}\n", collapse_displacement);
}

}  // namespace

SolverChoice quasi_static(const QuasiStaticSettings& settings) {
  return {settings_text(settings), [settings](const Bridge& bridge) -> SceneSolver {
            const auto solver = std::make_shared<QuasiStaticSolver>(bridge, settings);
            return [solver](std::span<const SceneStart> scenes) { return solver->solve(scenes); };
          }};
}

}  // namespace voussoir
