#include "generator/first_order_residual.h"

#include <oneapi/tbb/enumerable_thread_specific.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "generator/error_fit.h"
#include "generator/parallel.h"
#include "generator/scene_list.h"

namespace voussoir {
namespace {

constexpr std::size_t kIntact = 0;  // the first scene
constexpr std::size_t kBridgesAtOnce = 8;

/// A bridge drawn at random, in an epoch.
struct SampledBridge {
  Eigen::VectorXd theta;  ///< of the bridge, then of the epoch
  Eigen::Index of_bridge = 0;
  Parameters parameters;
  Stage epoch;
};

/// A scene of a sampled bridge.
struct Case {
  const SampledBridge* bridge;
  std::size_t scene;
  std::size_t intact;  ///< the case of the same bridge without missing blocks
};

SampledBridge draw(const Model& bridge, const UncertainParameters& uncertain, std::uint64_t seed,
                   bool has_epoch) {
  const std::size_t of_bridge = uncertain.of_bridge.size();
  const std::size_t of_epoch = uncertain.of_epoch.size();
  SampledBridge sample{
      sampled_theta(of_bridge + of_epoch, seed), static_cast<Eigen::Index>(of_bridge), {}, {}};
  if (!has_epoch) sample.theta.tail(static_cast<Eigen::Index>(of_epoch)).setZero();
  sample.parameters =
      parameters_at(bridge, uncertain, sample.theta.head(static_cast<Eigen::Index>(of_bridge)));
  sample.epoch = in_epoch({}, bridge, uncertain, sample.theta.tail(static_cast<Eigen::Index>(of_epoch)));
  return sample;
}

/// What the control points of each case have moved in each state of the plan; empty where it does not stand.
using Moved = std::vector<std::vector<Eigen::VectorXd>>;

class CaseSolving {
 public:
  CaseSolving(const SensitivityStudy& study, const FirstOrder& first_order)
      : study_(study),
        first_order_(first_order),
        solver_(study.solver.make_equilibrium_solver(study.bridge)) {}

  /// Intact cases come before the others of their bridge.
  Moved solve(const std::vector<Case>& cases) const {
    std::vector<std::vector<Solution>> found(cases.size(), std::vector<Solution>(study_.states.size()));
    for (std::size_t state = 0; state < study_.states.size(); ++state) {
      std::vector<StageTask> tasks;
      std::vector<std::size_t> places;
      for (std::size_t i = 0; i < cases.size(); ++i) {
        if (loses_nothing(cases[i], state)) found[i][state] = found[i][kBuilt];
        if (const auto task = task_of(cases[i], i, state, found)) {
          tasks.push_back(*task);
          places.push_back(i);
        }
      }
      std::vector<Solution> solutions = solver_(tasks);
      for (std::size_t k = 0; k < places.size(); ++k) found[places[k]][state] = std::move(solutions[k]);
    }
    Moved moved(cases.size());
    for (std::size_t i = 0; i < cases.size(); ++i)
      for (const Solution& solution : found[i])
        moved[i].push_back(stands(solution)
                               ? vertical_displacements(solution.displacement, study_.bridge.control_points)
                               : Eigen::VectorXd());
    return moved;
  }

 private:
  bool loses_nothing(const Case& one, std::size_t state) const {
    return study_.states[state].is_loss() && one.scene == kIntact;
  }

  /// Nothing if the state is another one's or what comes before it does not stand.
  std::optional<StageTask> task_of(const Case& one, std::size_t place, std::size_t state,
                                   const std::vector<std::vector<Solution>>& found) const {
    const PlannedState& planned = study_.states[state];
    if (loses_nothing(one, state)) return std::nullopt;
    const Solution* before = nullptr;
    if (planned.before)
      before = planned.is_loss() ? &found[one.intact][kBuilt] : &found[place][*planned.before];
    if (before != nullptr && !stands(*before)) return std::nullopt;
    Stage stage = one.bridge->epoch;
    stage.scene = first_order_.scenes[one.scene];
    stage.load = planned.load;
    return StageTask{
        .stage = std::move(stage),
        .start = &first_order_.states[one.scene][state]->displacement,
        .before = before,
        .slipped = before == nullptr ? &first_order_.states[one.scene][kBuilt]->slipped : nullptr,
        .parameters = &one.bridge->parameters};
  }

  const SensitivityStudy& study_;
  const FirstOrder& first_order_;
  SceneSolver solver_;
};

/// The cases of each bridge solved, bridge after bridge.
Moved solve_cases(const SensitivityStudy& study, const FirstOrder& first_order,
                  std::span<const SampledBridge> bridges, const std::vector<std::size_t>& scenes) {
  const std::size_t groups = (bridges.size() + kBridgesAtOnce - 1) / kBridgesAtOnce;
  std::vector<Moved> of_group(groups);
  oneapi::tbb::enumerable_thread_specific<CaseSolving> solvers(
      [&] { return CaseSolving(study, first_order); });
  Crew(study.threads).for_each_index(groups, [&](std::size_t group) {
    std::vector<Case> cases;
    for (std::size_t i = group * kBridgesAtOnce; i < std::min(bridges.size(), (group + 1) * kBridgesAtOnce);
         ++i) {
      const std::size_t intact = cases.size();
      for (const std::size_t scene : scenes) cases.push_back({&bridges[i], scene, intact});
    }
    of_group[group] = solvers.local().solve(cases);
  });
  Moved moved;
  for (Moved& group : of_group) std::ranges::move(group, std::back_inserter(moved));
  return moved;
}

/// As few columns as have the covariance of these errors, each of variance 1.
Eigen::MatrixXd factor_of(const std::vector<Eigen::VectorXd>& errors, Eigen::Index points) {
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(points, points);
  for (const Eigen::VectorXd& error : errors)
    covariance += error * error.transpose() / static_cast<double>(errors.size());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> directions(covariance);
  return directions.eigenvectors() * directions.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
}

/// Scenes, the intact one and some singles, that stand in all states.
std::vector<std::size_t> sampled_scenes(const FirstOrder& first_order) {
  std::vector<std::size_t> standing;
  for (std::size_t scene = 1; scene < first_order.scenes.size(); ++scene)
    if (std::ranges::all_of(first_order.derivatives,
                            [&](const auto& state) { return state[scene].size() > 0; }))
      standing.push_back(scene);
  std::vector<std::size_t> scenes = evenly_chosen(standing, kSampledSingles);
  scenes.insert(scenes.begin(), kIntact);
  return scenes;
}

/// Everything that has been solved.
struct Samples {
  std::vector<SampledBridge> still;   ///< at the temperature and with the supports of the file
  std::vector<SampledBridge> moving;  ///< the same bridges in an epoch
  std::vector<std::size_t> scenes;    ///< that are solved of the first kBridgesWithSingles
  Moved at_rest, moved;               ///< the intact scene of each
  Moved few_at_rest, few_moved;       ///< `scenes` of the first
};

Samples solve_samples(const SensitivityStudy& study, const UncertainParameters& uncertain,
                      const FirstOrder& first_order) {
  Samples samples;
  for (std::size_t i = 0; i < kSampledBridges; ++i) {
    samples.still.push_back(draw(study.bridge, uncertain, kFirstSampledSeed + i, false));
    samples.moving.push_back(draw(study.bridge, uncertain, kFirstSampledSeed + i, true));
  }
  samples.scenes = sampled_scenes(first_order);
  samples.at_rest = solve_cases(study, first_order, samples.still, {kIntact});
  samples.moved = solve_cases(study, first_order, samples.moving, {kIntact});
  const auto few = [](const std::vector<SampledBridge>& bridges) {
    return std::span(bridges.data(), kBridgesWithSingles);
  };
  samples.few_at_rest = solve_cases(study, first_order, few(samples.still), samples.scenes);
  samples.few_moved = solve_cases(study, first_order, few(samples.moving), samples.scenes);
  return samples;
}

/// One state, of which the intact bridge stands.
class StateResidual {
 public:
  StateResidual(const SensitivityStudy& study, const FirstOrder& first_order, const Samples& samples,
                std::size_t state, const std::vector<Eigen::MatrixXd>& slopes)
      : study_(study), first_order_(first_order), samples_(samples), state_(state), slopes_(slopes) {}

  FirstOrderResidual find() const {
    const Eigen::VectorXd intact = nominal(kIntact);
    const Eigen::MatrixXd& slope = slopes_[kIntact];
    std::vector<Eigen::VectorXd> of_bridge, of_epoch;
    for (std::size_t i = 0; i < kSampledBridges; ++i) {
      const Eigen::VectorXd& at_rest = samples_.at_rest[i][state_];
      const Eigen::VectorXd& moved = samples_.moved[i][state_];
      const Eigen::VectorXd& theta = samples_.still[i].theta;
      if (at_rest.size() == 0 || moved.size() == 0) continue;
      of_bridge.push_back(at_rest - intact - slope * theta);
      of_epoch.push_back(moved - at_rest - slope * (samples_.moving[i].theta - theta));
    }
    const SignalFits fits = fits_of_signals();
    return {
        factor_of(of_bridge, intact.size()), factor_of(of_epoch, intact.size()), std::sqrt(fits.bridge[0]),
        std::sqrt(fits.bridge[1]),           std::sqrt(fits.epoch[0]),           std::sqrt(fits.epoch[1])};
  }

 private:
  Eigen::VectorXd nominal(std::size_t scene) const {
    return vertical_displacements(first_order_.states[scene][state_]->displacement,
                                  study_.bridge.control_points);
  }

  /// Squares, as ErrorFit finds them.
  struct SignalFits {
    Eigen::Vector2d bridge, epoch;
  };

  SignalFits fits_of_signals() const {
    ErrorFit of_bridge, of_epoch;
    const Eigen::Index parameters = samples_.still.front().of_bridge;
    const std::size_t scenes = samples_.scenes.size();
    for (std::size_t i = 0; i < kBridgesWithSingles; ++i)
      for (std::size_t j = 1; j < scenes; ++j) {
        const auto at_rest = signal_of(samples_.few_at_rest, i * scenes, j);
        const auto moved = signal_of(samples_.few_moved, i * scenes, j);
        if (!at_rest || !moved) continue;
        const Eigen::MatrixXd slope = slopes_[samples_.scenes[j]] - slopes_[kIntact];
        const Eigen::VectorXd& theta = samples_.still[i].theta;
        const Eigen::VectorXd signal = nominal(samples_.scenes[j]) - nominal(kIntact);
        add(slope.leftCols(parameters), *at_rest - signal - slope * theta, of_bridge);
        add(slope.rightCols(slope.cols() - parameters),
            *moved - *at_rest - slope * (samples_.moving[i].theta - theta), of_epoch);
      }
    return {of_bridge.squares(), of_epoch.squares()};
  }

  std::optional<Eigen::VectorXd> signal_of(const Moved& moved, std::size_t intact, std::size_t scene) const {
    const Eigen::VectorXd& own = moved[intact + scene][state_];
    const Eigen::VectorXd& without_loss = moved[intact][state_];
    if (own.size() == 0 || without_loss.size() == 0) return std::nullopt;
    return own - without_loss;
  }

  static void add(const Eigen::MatrixXd& slope, const Eigen::VectorXd& error, ErrorFit& fit) {
    fit.add(error.array().isNaN().select(error, slope.rowwise().norm()), error);
  }

  const SensitivityStudy& study_;
  const FirstOrder& first_order_;
  const Samples& samples_;
  std::size_t state_;
  const std::vector<Eigen::MatrixXd>& slopes_;  ///< of each scene
};

}  // namespace

std::vector<FirstOrderResidual> first_order_residuals(const SensitivityStudy& study,
                                                      const UncertainParameters& uncertain,
                                                      const FirstOrder& first_order) {
  const std::vector<std::size_t> kept = kept_states(study.states);
  const auto points = static_cast<Eigen::Index>(study.bridge.control_points.size());
  std::vector<FirstOrderResidual> residuals(
      kept.size(), {Eigen::MatrixXd::Zero(points, points), Eigen::MatrixXd::Zero(points, points)});
  if (!study.solver.make_equilibrium_solver) return residuals;
  const Samples samples = solve_samples(study, uncertain, first_order);
  for (std::size_t k = 0; k < kept.size(); ++k)
    if (first_order.derivatives[k][kIntact].size() > 0)
      residuals[k] = StateResidual(study, first_order, samples, kept[k], first_order.derivatives[k]).find();
  return residuals;
}

}  // namespace voussoir
