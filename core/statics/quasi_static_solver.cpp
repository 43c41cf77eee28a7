#include "core/statics/quasi_static_solver.h"

#include <algorithm>
#include <optional>

#include "core/statics/equilibrium.h"
#include "core/statics/lane_factorisation.h"
#include "core/statics/newton_search.h"

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
struct LaneSearch {
  const StageTask* task = nullptr;
  std::size_t number = 0;
  int step = 0;                     ///< of the task's steps
  QuasiStaticSettings settings;     ///< the solver's, with the task's patience
  std::optional<Coefficients> own;  ///< of a variant that is not the solver's model
  std::optional<NewtonSearch> search;
  Solution reached;  ///< at the end of the last step; what all steps have cost

  Eigen::Matrix2Xd slipped() const { return task->slipped != nullptr ? *task->slipped : Eigen::Matrix2Xd(); }

  bool has_old_matrix() const { return search && !search->has_new_matrix(); }

  template <class Workspace>
  void begin(const StageTask& stage_task, std::size_t stage_number, std::size_t lane, Workspace& w) {
    task = &stage_task;
    number = stage_number;
    step = 0;
    settings = w.settings;
    if (task->before == nullptr) settings.descends_near = false;
    if (task->before == nullptr && !task->starts_near) settings.skips.kept_factors = false;
    // What is not found from near falls where joints are soft, and later stages stay near.
    const bool ends_near = task->before != nullptr || (task->starts_near && !settings.patient_first);
    if (ends_near || task->has_slipped()) settings.most_bold_iterations = 0;
    if (task->has_slipped() && !task->patiently)
      settings.most_patient_iterations = settings.most_slipped_iterations;
    own.reset();
    if (task->parameters != nullptr) own.emplace(w.system, *task->parameters);
    reached = Solution{};
    begin_step(task->before, task->start, lane, w);
  }

  /// Holds a share of the unbalanced forces back, so that all steps let go equal parts.
  template <class Workspace>
  void begin_step(const State* before, const Field* start, std::size_t lane, Workspace& w) {
    StageEquations equations(w.system, own ? *own : w.nominal, task->stage,
                             before != nullptr ? before->memory : memory_of_slip(slipped()));
    const int left = task->steps - ++step;
    settings.tolerance = left > 0 ? w.settings.step_tolerance : w.settings.tolerance;
    if (left > 0) hold_back(static_cast<double>(left) / (left + 1), before, equations);
    search.emplace(std::move(equations), settings, start, w.lane_of_tangents(lane), task->patiently,
                   step > 1);
  }

  /// Takes what the search has found; true if that is the task's answer, otherwise the next step begins, from
  /// where the structure gets if it goes on as in this one.
  template <class Workspace>
  bool end_step(std::size_t lane, Workspace& w) {
    const int before = reached.iterations;
    const Field from = step > 1                  ? reached.displacement
                       : task->before != nullptr ? task->before->displacement
                                                 : Field();
    std::vector<State> passed = std::move(reached.steps);
    if (task->keeps_steps && step > 1) passed.push_back(std::move(static_cast<State&>(reached)));
    reached = search->solution();
    reached.iterations += before;
    reached.steps = std::move(passed);
    if (task->before == nullptr && stands(reached)) reached.slipped = slipped();
    search.reset();
    if (step == task->steps || reached.outcome != Outcome::standing) return true;
    Field start = reached.displacement;
    if (from.size() > 0) start += reached.displacement - from;
    begin_step(&reached, &start, lane, w);
    return false;
  }

  static void hold_back(double share, const State* before, StageEquations& equations) {
    Field place = Field::Zero(2, equations.load.cols());
    if (before != nullptr) place = before->displacement.array().isNaN().select(0.0, before->displacement);
    equations.load -= share * unbalanced_forces(equations, place);
  }
};

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
  std::array<LaneSearch, kLanes> lanes;
  std::size_t next = 0;
  std::size_t solved = 0;
  while (solved < tasks.size()) {
    const bool refill = w.settings.skips.lane_refill || solved == next;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if (!lanes[lane].search && refill && next < tasks.size()) {
        lanes[lane].begin(tasks[next], next, lane, w);
        ++next;
      }
      if (lanes[lane].search) w.put_right_hand_side(lane, lanes[lane].search->unbalanced());
    }
    const bool factorises = std::ranges::none_of(lanes, &LaneSearch::has_old_matrix);
    if (factorises) w.factorise();
    w.linear.solve(w.steps);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      std::optional<NewtonSearch>& search = lanes[lane].search;
      if (!search || (search->has_new_matrix() && !factorises)) continue;
      search->advance(w.regular[lane], w.get_step(lane));
      if (!search->finished() || !lanes[lane].end_step(lane, w)) continue;
      solutions[lanes[lane].number] = std::move(lanes[lane].reached);
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
