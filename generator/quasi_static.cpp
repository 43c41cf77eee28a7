#include <fmt/format.h>

#include <memory>

#include "generator/scene_solving.h"

namespace voussoir {
namespace {

std::string settings_text(const QuasiStaticSettings& settings) {
  const auto& [tolerance, most_iterations, most_fallback_iterations, collapse_displacement] = settings;
  return fmt::format(
      "solver = quasi-static\ntolerance = {}\nmost_iterations = {}\nmost_fallback_iterations = {}\n"
      "collapse_displacement_m = {}\n",
      tolerance, most_iterations, most_fallback_iterations, collapse_displacement);
}

}  // namespace

SolverChoice quasi_static(const QuasiStaticSettings& settings) {
  return {settings_text(settings), [settings](const Bridge& bridge) -> SceneSolver {
            const auto solver = std::make_shared<QuasiStaticSolver>(bridge, settings);
            return [solver](const Scene& scene, const std::optional<Field>& start) {
              return start ? solver->solve(scene, *start) : solver->solve(scene);
            };
          }};
}

}  // namespace voussoir
