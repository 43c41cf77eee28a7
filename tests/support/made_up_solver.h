#pragma once
/// @file A solver that makes its answers up: quick, different for every scene and every start.

#include <atomic>
#include <memory>

#include "generator/scenes/solvers.h"
#include "tests/support/made_up_database.h"

namespace voussoir::test {

/// Answers are those of made_up_solution, smaller with stiffer joints, plus a tenth of the start, so that a
/// wrong bridge and a wrong start show.
inline Solution answer_from(const Model& bridge, const Scene& scene, const std::optional<Field>& start) {
  Solution solution = made_up_solution(bridge, scene);
  solution.displacement *=
      JointMaterial{}.normal_stiffness / bridge.parameters.joints.front().normal_stiffness;
  if (start) solution.displacement += 0.1 * *start;
  return solution;
}

/// Later stages add what they are given: a wrong load and a wrong memory show, too.
inline Solution answer_of(const Model& bridge, const StageTask& task) {
  Solution solution =
      answer_from(bridge, task.stage.scene, task.start ? std::optional(*task.start) : std::nullopt);
  if (task.before == nullptr) return solution;
  double slips = 0.0;
  for (const JointMemory& memory : task.before->memory) slips += memory.slip_0 + 2.0 * memory.slip_1;
  solution.displacement.array() += 1e-3 * slips;
  if (task.stage.load.size() > 0) solution.displacement += 1e-8 * task.stage.load;
  return solution;
}

/// What every solver does with its scenes, one after the other.
template <class Answer>
StageSolver one_by_one(const Answer& answer) {
  return [answer](std::span<const StageTask> tasks) {
    std::vector<Solution> solutions;
    for (const StageTask& task : tasks) solutions.push_back(answer(task));
    return solutions;
  };
}

inline std::string made_up_settings(const Model&) {
  return "solver = made up\n";
}

inline SolverChoice made_up_solver() {
  return {made_up_settings, [](const Model& bridge, const std::string&) {
            return one_by_one([&bridge](const StageTask& task) { return answer_of(bridge, task); });
          }};
}

/// The same, but throws Failure at its `scenes`-th answer and from then on, like a build that is interrupted.
inline SolverChoice failing_solver(int scenes) {
  const auto left = std::make_shared<std::atomic<int>>(scenes);
  return {made_up_settings, [left](const Model& bridge, const std::string&) {
            return one_by_one([&bridge, left](const StageTask& task) {
              if (--*left <= 0) throw Failure("interrupted");
              return answer_of(bridge, task);
            });
          }};
}

}  // namespace voussoir::test
