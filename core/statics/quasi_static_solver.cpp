#include "core/statics/quasi_static_solver.h"

#include <algorithm>
#include <optional>

#include "core/statics/equilibrium.h"
#include "core/statics/lane_factorisation.h"
#include "core/statics/stage_steps.h"

namespace voussoir {

struct QuasiStaticSolver::Workspace {
  QuasiStaticSettings settings;
  EquilibriumSystem system;
  Coefficients nominal;
  LaneFactorisation linear;
  LaneVector tangents;
  LaneVector steps;
  Eigen::VectorXd step;
  std::array<bool, kLanes> regular{};  ///< the matrices in the lanes, when they were factorised

  Workspace(const Model& model, QuasiStaticSettings settings_)
      : settings(settings_),
        system(model, settings.joint_rule),
        nominal(system, model.parameters),
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

  void factorise() {
    if (!settings.skips.shared_analysis) linear = LaneFactorisation(system.pattern);
    regular = linear.factorise(tangents);
  }
};

namespace {

/// A task under way in a lane.
struct LaneTask {
  template <class... Arguments>
  LaneTask(std::size_t task, const Arguments&... arguments) : number(task), steps(arguments...) {}

  std::size_t number;
  StageSteps steps;
};

bool has_old_matrix(const std::optional<LaneTask>& lane) {
  return lane && !lane->steps.search().has_new_matrix();
}

}  // namespace

QuasiStaticSolver::QuasiStaticSolver(const Model& model, QuasiStaticSettings settings)
    : workspace_(std::make_unique<Workspace>(model, settings)) {}
QuasiStaticSolver::~QuasiStaticSolver() = default;
QuasiStaticSolver::QuasiStaticSolver(QuasiStaticSolver&&) noexcept = default;
QuasiStaticSolver& QuasiStaticSolver::operator=(QuasiStaticSolver&&) noexcept = default;

/// A factorisation takes as long as six solutions and all lanes together, so it waits until every search
/// needs one.
std::vector<Solution> QuasiStaticSolver::solve(std::span<const StageTask> tasks) {
  Workspace& w = *workspace_;
  std::vector<Solution> solutions(tasks.size());
  std::array<std::optional<LaneTask>, kLanes> lanes;
  std::size_t next = 0;
  std::size_t solved = 0;
  while (solved < tasks.size()) {
    const bool refill = w.settings.skips.lane_refill || solved == next;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if (!lanes[lane] && refill && next < tasks.size()) {
        lanes[lane].emplace(next, w.system, w.nominal, w.settings, tasks[next], w.lane_of_tangents(lane));
        ++next;
      }
      if (lanes[lane]) w.put_right_hand_side(lane, lanes[lane]->steps.search().unbalanced());
    }
    const bool factorises = std::ranges::none_of(lanes, has_old_matrix);
    if (factorises) w.factorise();
    w.linear.solve(w.steps);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      std::optional<LaneTask>& under_way = lanes[lane];
      if (!under_way || (under_way->steps.search().has_new_matrix() && !factorises)) continue;
      if (!under_way->steps.advance(w.regular[lane], w.get_step(lane))) continue;
      solutions[under_way->number] = under_way->steps.take();
      under_way.reset();
      ++solved;
    }
  }
  return solutions;
}

Solution QuasiStaticSolver::solve(const StageTask& task) {
  return std::move(solve({&task, 1}).front());
}

Solution QuasiStaticSolver::solve(const Scene& scene) {
  return solve(StageTask{.stage = {.scene = scene}});
}

Solution QuasiStaticSolver::solve(const Scene& scene, const Field& start) {
  return solve(StageTask{.stage = {.scene = scene}, .start = &start});
}

const EquilibriumSystem& QuasiStaticSolver::system() const {
  return workspace_->system;
}

}  // namespace voussoir
