#include "generator/sensitivities.h"

#include <oneapi/tbb/enumerable_thread_specific.h>

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "core/solve/history.h"
#include "core/statics/sensitivity.h"
#include "generator/parallel.h"

namespace voussoir {
namespace {

constexpr std::size_t kBuilt = 0;

/// A stored field solves a step if no more of the forces is unbalanced than rounding and another path of no
/// account leave [largest nodal weight].
constexpr double kSameEquilibrium = 1e-3;

bool stands(const std::optional<Solution>& solution) {
  return solution && solution->outcome == Outcome::standing;
}

/// Intact, and the singles of the list, in their order.
std::vector<Scene> studied_scenes(const std::vector<Scene>& scenes) {
  std::vector<Scene> studied = {Scene{}};
  std::ranges::copy_if(scenes, std::back_inserter(studied),
                       [](const Scene& scene) { return scene.missing() == 1; });
  std::ranges::sort(studied);
  const auto twice = std::ranges::unique(studied);
  studied.erase(twice.begin(), twice.end());
  return studied;
}

/// The states of the scenes, solved where they are not known.
std::vector<SceneStates> states_of(const SensitivityStudy& study, const std::vector<Scene>& scenes,
                                   const KnownRecords& known) {
  std::vector<SceneGroup> groups;
  bool all_known = true;
  for (const Scene& scene : scenes) {
    const RecordKey key{kNominalVariant, scene};
    const bool is_known = known.can_start(key);
    groups.push_back(
        {.solved = scene, .states = is_known ? known.states(key) : known.old_states(key), .image = {}});
    all_known = all_known && is_known;
  }
  if (!all_known) {
    const StateSolving solving(study.bridge, study.states);
    const SceneSolver solver = study.solver.make_solver(study.bridge, study.settings);
    StartingFields starts;
    solving.solve(solver, solving.basis(solver, starts, true), std::span(groups).first(1));
    for (std::size_t state = 0; state < study.states.size(); ++state)
      starts.add({}, state, *groups.front().states[state]);
    solving.solve(solver, solving.basis(solver, std::move(starts), true), std::span(groups).subspan(1));
  }
  std::vector<SceneStates> states;
  for (SceneGroup& group : groups) states.push_back(std::move(group.states));
  return states;
}

/// What all threads share.
struct Equations {
  Equations(const Model& bridge, const Uncertainty& uncertainty)
      : system(bridge),
        coefficients(system, bridge.parameters),
        uncertain(uncertain_parameters(bridge, uncertainty)),
        readings(vertical_readings(bridge, bridge.control_points)) {}

  EquilibriumSystem system;
  Coefficients coefficients;
  UncertainParameters uncertain;
  Eigen::MatrixXd readings;
};

/// Derivatives of one scene's states, on one thread.
class SceneDerivatives {
 public:
  SceneDerivatives(const SensitivityStudy& study, const Equations& equations)
      : study_(study), equations_(equations), derivatives_(equations.system, equations.uncertain) {}

  /// Points x parameters; empty if the scene does not stand.
  Eigen::MatrixXd of(const Scene& scene, std::size_t state, const SceneStates& states,
                     const SceneStates& intact) {
    const auto history = history_of(scene, state, states, intact);
    if (!history) return {};
    return derivatives_.solve(*history, equations_.readings).value_or(Eigen::MatrixXd());
  }

 private:
  std::optional<SolvedHistory> history_of(const Scene& scene, std::size_t state, const SceneStates& states,
                                          const SceneStates& intact) {
    const PlannedState& planned = study_.states[state];
    const bool is_loss = planned.before && !planned.is_load;
    if (!stands(states[state])) return std::nullopt;
    if (is_loss && scene.removed.empty()) return history_of(scene, kBuilt, states, intact);
    std::optional<SolvedHistory> history = SolvedHistory{};
    if (planned.before)
      history = is_loss ? history_of(Scene{}, kBuilt, intact, intact)
                        : history_of(scene, *planned.before, states, intact);
    if (history) append(scene, planned, *states[state], is_loss, *history);
    return history;
  }

  void append(const Scene& scene, const PlannedState& planned, const Solution& solution, bool is_loss,
              SolvedHistory& history) {
    const Stage stage{.scene = scene, .load = planned.load};
    append_stage(equations_.system, equations_.coefficients, stage, solution, 1, history);
    if (!is_loss ||
        unbalanced_force(history.back().equations, history.back().displacement) <= kSameEquilibrium)
      return;
    history.pop_back();
    const State before{history.back().displacement,
                       updated_memory(history.back().equations, history.back().displacement)};
    if (!solver_) solver_ = study_.solver.make_solver(study_.bridge, study_.settings);
    const StageTask task{.stage = stage,
                         .start = &before.displacement,
                         .before = &before,
                         .steps = kStepsOfLoss,
                         .keeps_steps = true};
    const std::vector<Solution> anew = solver_({&task, 1});
    if (anew.front().outcome == Outcome::standing)
      append_stage(equations_.system, equations_.coefficients, stage, anew.front(), kStepsOfLoss, history);
    else
      append_stage(equations_.system, equations_.coefficients, stage, solution, 1, history);
  }

  const SensitivityStudy& study_;
  const Equations& equations_;
  SensitivitySolver derivatives_;
  SceneSolver solver_;
};

/// Of each kept state and each scene.
std::vector<std::vector<Eigen::MatrixXd>> derivatives_of(const SensitivityStudy& study,
                                                         const Equations& equations,
                                                         const std::vector<Scene>& scenes,
                                                         const std::vector<SceneStates>& states) {
  const std::vector<std::size_t> kept = kept_states(study.states);
  std::vector<std::vector<Eigen::MatrixXd>> derivatives(kept.size(),
                                                        std::vector<Eigen::MatrixXd>(scenes.size()));
  oneapi::tbb::enumerable_thread_specific<SceneDerivatives> workers(
      [&] { return SceneDerivatives(study, equations); });
  Crew(study.threads).for_each_index(scenes.size(), [&](std::size_t i) {
    SceneDerivatives& worker = workers.local();
    for (std::size_t state = 0; state < kept.size(); ++state)
      derivatives[state][i] = worker.of(scenes[i], kept[state], states[i], states.front());
  });
  return derivatives;
}

using Directions = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>;

/// The directions of largest eigenvalues, largest first, until `enough` holds of what is left: the sum of the
/// other eigenvalues and the next one.
template <class Enough>
Eigen::MatrixXd leading_directions(const Eigen::MatrixXd& gram, const Enough& enough) {
  const Directions directions(gram);
  double left = directions.eigenvalues().cwiseMax(0.0).sum();
  Eigen::Index count = 0;
  const Eigen::Index size = gram.rows();
  while (count < size && !enough(left, directions.eigenvalues()[size - 1 - count])) {
    left -= std::max(0.0, directions.eigenvalues()[size - 1 - count]);
    ++count;
  }
  return directions.eigenvectors().rightCols(count).rowwise().reverse();
}

}  // namespace

Eigen::MatrixXd sensitivity_basis(const std::vector<std::vector<Eigen::MatrixXd>>& derivatives,
                                  Eigen::Index of_bridge) {
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(of_bridge, of_bridge);
  for (const auto& state : derivatives)
    if (state.front().size() > 0)
      gram += state.front().leftCols(of_bridge).transpose() * state.front().leftCols(of_bridge);
  const Eigen::MatrixXd of_intact =
      leading_directions(gram, [](double, double next) { return next < kLeastDeviation * kLeastDeviation; });

  gram.setZero();
  double count = 0.0;
  for (const auto& state : derivatives)
    for (std::size_t i = 1; i < state.size(); ++i) {
      if (state[i].size() == 0 || state.front().size() == 0) continue;
      const Eigen::MatrixXd signal = (state[i] - state.front()).leftCols(of_bridge);
      if (signal.squaredNorm() == 0.0) continue;
      const Eigen::MatrixXd left = signal - (signal * of_intact) * of_intact.transpose();
      gram += left.transpose() * left / signal.squaredNorm();
      count += 1.0;
    }
  const Eigen::MatrixXd of_signals =
      leading_directions(gram, [&](double left, double) { return left <= kLeftOfSignals * count; });
  Eigen::MatrixXd basis(of_bridge, of_intact.cols() + of_signals.cols());
  basis << of_intact, of_signals;
  return basis;
}

std::optional<Sensitivities> find_sensitivities(const SensitivityStudy& study,
                                                const std::vector<Scene>& scenes, const KnownRecords& known) {
  // Sums are ordered by the sizes of caches: the same ones everywhere give the same bits.
  Eigen::setCpuCacheSizes(32 * 1024, 256 * 1024, 2 * 1024 * 1024);
  const Equations equations(study.bridge, study.uncertainty);
  Sensitivities result;
  result.parameters = equations.uncertain.all();
  if (result.parameters.empty()) return std::nullopt;
  result.scenes = studied_scenes(scenes);
  const std::vector<SceneStates> states = states_of(study, result.scenes, known);
  if (!stands(states.front()[kBuilt])) return std::nullopt;
  auto derivatives = derivatives_of(study, equations, result.scenes, states);
  const auto of_bridge = static_cast<Eigen::Index>(equations.uncertain.of_bridge.size());
  result.basis = sensitivity_basis(derivatives, of_bridge);
  const auto points = static_cast<Eigen::Index>(study.bridge.control_points.size());
  for (auto& state : derivatives) {
    StateSensitivities& one = result.states.emplace_back();
    for (Eigen::MatrixXd& scene : state)
      one.scenes.push_back(scene.size() == 0 ? SceneFactors{}
                                             : SceneFactors{scene.leftCols(of_bridge) * result.basis,
                                                            scene.rightCols(scene.cols() - of_bridge)});
    one.residual = {Eigen::MatrixXd(points, 0), Eigen::MatrixXd(points, 0), 0.0, 0.0};
  }
  return result;
}

}  // namespace voussoir
