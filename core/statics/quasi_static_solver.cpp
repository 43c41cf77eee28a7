#include "core/statics/quasi_static_solver.h"

#include <optional>

#include "core/statics/equilibrium.h"
#include "core/statics/lane_factorisation.h"
#include "core/statics/newton_search.h"

namespace voussoir {

struct QuasiStaticSolver::Workspace {
  QuasiStaticSettings settings;
  EquilibriumSystem system;
  LaneFactorisation linear;
  LaneVector tangents;
  LaneVector steps;
  Eigen::VectorXd step;

  Workspace(const Bridge& bridge, QuasiStaticSettings settings_, const Field& dead_load)
      : settings(settings_),
        system(bridge, dead_load, settings.joint_rule),
        linear(system.pattern),
        tangents(static_cast<std::size_t>(system.pattern.nonZeros())),
        steps(static_cast<std::size_t>(system.unknown_count())),
        step(system.unknown_count()) {}

  TangentTarget lane_of_tangents(std::size_t lane) {
    return {reinterpret_cast<double*>(tangents.data()) + lane, kLanes};
  }

  void put_right_hand_side(std::size_t lane, const Field& unbalanced) {
    for (std::size_t i = 0; i < steps.size(); ++i)
      steps[i].value[lane] = unbalanced.data()[system.component[i]];
  }
  const Eigen::VectorXd& get_step(std::size_t lane) {
    for (std::size_t i = 0; i < steps.size(); ++i) step[static_cast<Eigen::Index>(i)] = steps[i].value[lane];
    return step;
  }
};

QuasiStaticSolver::QuasiStaticSolver(const Bridge& bridge, QuasiStaticSettings settings,
                                     const Field& dead_load)
    : workspace_(std::make_unique<Workspace>(bridge, settings, dead_load)) {}
QuasiStaticSolver::~QuasiStaticSolver() = default;
QuasiStaticSolver::QuasiStaticSolver(QuasiStaticSolver&&) noexcept = default;
QuasiStaticSolver& QuasiStaticSolver::operator=(QuasiStaticSolver&&) noexcept = default;

std::vector<Solution> QuasiStaticSolver::solve(std::span<const SceneStart> scenes) {
  Workspace& w = *workspace_;
  std::vector<Solution> solutions(scenes.size());
  std::array<std::optional<NewtonSearch>, kLanes> searches;
  std::array<std::size_t, kLanes> scene_in_lane{};
  std::size_t next = 0;
  std::size_t solved = 0;
  while (solved < scenes.size()) {
    const bool refill = w.settings.skips.lane_refill || solved == next;
    if (!w.settings.skips.shared_analysis) w.linear = LaneFactorisation(w.system.pattern);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if (!searches[lane] && refill && next < scenes.size()) {
        const SceneStart& task = scenes[next];
        searches[lane].emplace(w.system, w.settings, task.scene, task.start, w.lane_of_tangents(lane));
        scene_in_lane[lane] = next++;
      }
      if (searches[lane]) w.put_right_hand_side(lane, searches[lane]->unbalanced());
    }
    const std::array<bool, kLanes> regular = w.linear.factorise(w.tangents);
    w.linear.solve(w.steps);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if (!searches[lane]) continue;
      searches[lane]->advance(regular[lane], w.get_step(lane));
      if (!searches[lane]->finished()) continue;
      solutions[scene_in_lane[lane]] = searches[lane]->solution();
      searches[lane].reset();
      ++solved;
    }
  }
  return solutions;
}

Solution QuasiStaticSolver::solve(const Scene& scene) {
  const SceneStart task{scene, nullptr};
  return solve({&task, 1}).front();
}

Solution QuasiStaticSolver::solve(const Scene& scene, const Field& start) {
  const SceneStart task{scene, &start};
  return solve({&task, 1}).front();
}

}  // namespace voussoir
