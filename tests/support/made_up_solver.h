#pragma once
/// @file A solver that makes its answers up: quick, different for every scene and every start.

#include <atomic>
#include <memory>

#include "generator/scene_solving.h"
#include "tests/support/made_up_database.h"

namespace voussoir::test {

/// Answers are those of made_up_solution plus a tenth of the start, so that a wrong start shows.
inline Solution answer_from(const Bridge& bridge, const Scene& scene, const std::optional<Field>& start) {
  Solution solution = made_up_solution(bridge, scene);
  if (start) solution.displacement += 0.1 * *start;
  return solution;
}

inline SolverChoice made_up_solver() {
  return {"solver = made up\n", [](const Bridge& bridge) -> SceneSolver {
            return [&bridge](const Scene& scene, const std::optional<Field>& start) {
              return answer_from(bridge, scene, start);
            };
          }};
}

/// The same, but throws Failure at its `scenes`-th answer and from then on, like a build that is interrupted.
inline SolverChoice failing_solver(int scenes) {
  const auto left = std::make_shared<std::atomic<int>>(scenes);
  return {"solver = made up\n", [left](const Bridge& bridge) -> SceneSolver {
            return [&bridge, left](const Scene& scene, const std::optional<Field>& start) {
              if (--*left <= 0) throw Failure("interrupted");
              return answer_from(bridge, scene, start);
            };
          }};
}

}  // namespace voussoir::test
