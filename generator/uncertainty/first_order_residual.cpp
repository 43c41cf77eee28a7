#include "generator/uncertainty/first_order_residual.h"

#include <fmt/format.h>
#include <oneapi/tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>

#include "generator/running/parallel.h"
#include "generator/uncertainty/error_fit.h"
#include "generator/uncertainty/joint_factors.h"

namespace voussoir {
namespace {

constexpr std::size_t kBridgesAtOnce = 8;
constexpr double kLargeShare = 3.0;  // FirstOrderResidual's, from which on the user is told

/// The intact scene and the singles that stand in some state.
std::vector<std::size_t> sampled_scenes(const FirstOrder& first_order) {
  std::vector<std::size_t> scenes = {kIntactScene};
  for (std::size_t scene = 1; scene < first_order.nominal.scenes.size(); ++scene)
    if (std::ranges::any_of(first_order.derivatives,
                            [&](const auto& state) { return state[scene].size() > 0; }))
      scenes.push_back(scene);
  return scenes;
}

/// Everything that has been solved.
struct Samples {
  std::vector<SampledBridge> bridges;
  std::vector<std::size_t> scenes;   ///< that are solved of the first kBridgesWithSingles
  std::vector<SampledScene> few;     ///< `scenes` of these, bridge after bridge
  std::vector<SampledScene> intact;  ///< the intact scene of each bridge
};

/// The scenes of each bridge solved, bridge after bridge.
std::vector<SampledScene> solve_scenes(const SensitivityStudy& study, const NominalScenes& nominal,
                                       std::span<const SampledBridge> bridges,
                                       const std::vector<std::size_t>& scenes, std::size_t at_once,
                                       Progress& progress) {
  const std::size_t groups = (bridges.size() + at_once - 1) / at_once;
  std::vector<std::vector<SampledScene>> of_group(groups);
  oneapi::tbb::enumerable_thread_specific<SampledHistories> solvers(
      [&] { return SampledHistories(study, nominal.scenes); });
  Crew(study.threads).for_each_index(groups, [&](std::size_t group) {
    const std::size_t first = group * at_once;
    const std::size_t count = std::min(at_once, bridges.size() - first);
    of_group[group] = solvers.local().solve(bridges.subspan(first, count), scenes);
    progress.advance(count);
  });
  std::vector<SampledScene> solved;
  for (auto& group : of_group) std::ranges::move(group, std::back_inserter(solved));
  return solved;
}

Samples solve_samples(const SensitivityStudy& study, const UncertainParameters& uncertain,
                      const FirstOrder& first_order, Progress& progress) {
  Samples samples;
  const std::size_t count = sampled_bridge_count(study.bridge.control_points.size());
  for (std::size_t i = 0; i < count; ++i)
    samples.bridges.push_back(draw_bridge(study.bridge, uncertain, kFirstSampledSeed + i));
  samples.scenes = sampled_scenes(first_order);
  const std::span<const SampledBridge> bridges = samples.bridges;
  progress.start(count, 0, "sampled bridges");
  samples.few = solve_scenes(study, first_order.nominal, bridges.first(kBridgesWithSingles), samples.scenes,
                             1, progress);
  for (std::size_t i = 0; i < kBridgesWithSingles; ++i)
    samples.intact.push_back(samples.few[i * samples.scenes.size()]);
  std::ranges::move(solve_scenes(study, first_order.nominal, bridges.subspan(kBridgesWithSingles),
                                 {kIntactScene}, kBridgesAtOnce, progress),
                    std::back_inserter(samples.intact));
  progress.finish();
  return samples;
}

/// One state.
class StateResidual {
 public:
  StateResidual(const SensitivityStudy& study, const FirstOrder& first_order, const Samples& samples,
                std::size_t state, const std::vector<Eigen::MatrixXd>& slopes)
      : study_(study), first_order_(first_order), samples_(samples), state_(state), slopes_(slopes) {
    if (stands()) signals_ = sampled_signals();
  }

  /// Does the nominal intact bridge?
  bool stands() const { return slopes_[kIntactScene].size() > 0; }

  /// What the first order leaves of each intact bridge at rest.
  StateErrors errors_of_bridges() const {
    return errors([&](const SampledBridge& bridge, const Settled& at_rest, const Settled&) {
      return (at_rest[state_] - nominal(kIntactScene) -
              slopes_[kIntactScene].leftCols(bridge.of_bridge.size()) * bridge.of_bridge)
          .eval();
    });
  }

  /// And of what an epoch adds to it.
  StateErrors errors_of_epochs() const {
    return errors([&](const SampledBridge& bridge, const Settled& at_rest, const Settled& in_epoch) {
      return (in_epoch[state_] - at_rest[state_] -
              slopes_[kIntactScene].rightCols(bridge.of_epoch.size()) * bridge.of_epoch)
          .eval();
    });
  }

  /// The shares of signals.
  FirstOrderResidual shares() const {
    if (!stands()) return {};
    const SignalFits fits = signals_.empty() ? kAsMuchAsItSays : fits_of_signals();
    return {{},
            {},
            std::sqrt(fits.bridge[0]),
            std::sqrt(fits.bridge[1]),
            std::sqrt(fits.epoch[0]),
            std::sqrt(fits.epoch[1])};
  }

  /// What the first order leaves of what epochs change of each scene's signal: points x bridges, over the
  /// root of their number.
  std::vector<Eigen::MatrixXd> left_of_signals() const {
    std::vector<Eigen::MatrixXd> left(first_order_.nominal.scenes.size());
    const double root = std::sqrt(static_cast<double>(kBridgesWithSingles));
    for (const SampledSignal& signal : signals_) {
      Eigen::MatrixXd& to = left[signal.scene];
      if (to.size() == 0)
        to = Eigen::MatrixXd::Zero(signal.left_of_epoch.size(), Eigen::Index{kBridgesWithSingles});
      to.col(static_cast<Eigen::Index>(signal.bridge)) =
          signal.left_of_epoch.array().isNaN().select(0.0, signal.left_of_epoch) / root;
    }
    return left;
  }

  /// Does any single stand in a sampled bridge?
  bool has_signals() const { return !signals_.empty(); }

 private:
  /// Of each bridge that stands at rest and in its epoch; of others nothing.
  template <class ErrorOf>
  StateErrors errors(ErrorOf error_of) const {
    StateErrors result(samples_.bridges.size());
    for (std::size_t i = 0; stands() && i < result.size(); ++i) {
      const auto& [at_rest, in_epoch] = samples_.intact[i];
      if (at_rest[state_].size() > 0 && in_epoch[state_].size() > 0)
        result[i] = error_of(samples_.bridges[i], at_rest, in_epoch);
    }
    return result;
  }

  Eigen::VectorXd nominal(std::size_t scene) const {
    return readings_at(study_.bridge.control_points,
                       first_order_.nominal.states[scene][state_]->displacement);
  }

  /// Squares, as ErrorFit finds them.
  struct SignalFits {
    Eigen::Vector2d bridge, epoch;
  };

  /// Where nothing could be compared: no signal shows that the first order is any good.
  static inline const SignalFits kAsMuchAsItSays{{1.0, 0.0}, {1.0, 0.0}};

  SignalFits fits_of_signals() const {
    ErrorFit of_bridge, of_epoch;
    for (const SampledSignal& signal : signals_) {
      const Eigen::MatrixXd slope = slope_of_signal(signal.scene);
      const Eigen::Index parameters = samples_.bridges.front().of_bridge.size();
      add(slope.leftCols(parameters), signal.left_of_bridge, of_bridge);
      add(slope.rightCols(slope.cols() - parameters), signal.left_of_epoch, of_epoch);
    }
    return {of_bridge.squares(), of_epoch.squares()};
  }

  Eigen::MatrixXd slope_of_signal(std::size_t scene) const { return slopes_[scene] - slopes_[kIntactScene]; }

  /// A single of a sampled bridge that stands at rest and in its epoch: what the first order leaves of its
  /// signal [m], NaN where it has no such point.
  struct SampledSignal {
    std::size_t bridge, scene;
    Eigen::VectorXd left_of_bridge, left_of_epoch;
  };

  std::vector<SampledSignal> sampled_signals() const {
    std::vector<SampledSignal> signals;
    const std::size_t scenes = samples_.scenes.size();
    for (std::size_t i = 0; i < kBridgesWithSingles; ++i)
      for (std::size_t j = 1; j < scenes; ++j) {
        const std::size_t scene = samples_.scenes[j];
        const SampledScene &intact = samples_.few[i * scenes], &single = samples_.few[i * scenes + j];
        const auto at_rest = signal_of(intact.at_rest, single.at_rest);
        const auto in_epoch = signal_of(intact.in_epoch, single.in_epoch);
        if (!at_rest || !in_epoch || slopes_[scene].size() == 0) continue;
        const SampledBridge& bridge = samples_.bridges[i];
        const Eigen::MatrixXd slope = slope_of_signal(scene);
        const Eigen::VectorXd nominal_signal = nominal(scene) - nominal(kIntactScene);
        signals.push_back(
            {i, scene, *at_rest - nominal_signal - slope.leftCols(bridge.of_bridge.size()) * bridge.of_bridge,
             *in_epoch - *at_rest - slope.rightCols(bridge.of_epoch.size()) * bridge.of_epoch});
      }
    return signals;
  }

  /// Nothing of what does not stand, or has lost all points.
  std::optional<Eigen::VectorXd> signal_of(const Settled& intact, const Settled& single) const {
    if (intact[state_].size() == 0 || single[state_].size() == 0) return std::nullopt;
    Eigen::VectorXd signal = single[state_] - intact[state_];
    if (signal.array().isNaN().all()) return std::nullopt;
    return signal;
  }

  static void add(const Eigen::MatrixXd& slope, const Eigen::VectorXd& error, ErrorFit& fit) {
    fit.add(error.array().isNaN().select(error, slope.rowwise().norm()), error);
  }

  const SensitivityStudy& study_;
  const FirstOrder& first_order_;
  const Samples& samples_;
  std::size_t state_;
  const std::vector<Eigen::MatrixXd>& slopes_;  ///< of each scene
  std::vector<SampledSignal> signals_{};
};

void warn_of(const FirstOrderResidual& residual, bool has_signals, const std::string& state,
             Progress& progress) {
  if (!has_signals)
    progress.say(fmt::format(
        "{}: no single stands in the sampled bridges, so what the first order leaves of signals is "
        "not known: it is taken to be as much as the first order itself",
        state));
  const double largest =
      std::max({residual.share, residual.common, residual.epoch_share, residual.epoch_common});
  if (largest > kLargeShare)
    progress.say(fmt::format(
        "{}: the first order leaves {:.1f} times as much of what parameters make of losses as it says, "
        "so readings will hardly show them",
        state, largest));
}

}  // namespace

std::size_t sampled_bridge_count(std::size_t points) {
  constexpr std::size_t of_each_point = 5, fewest = 128, most = 400;
  return std::clamp(of_each_point * points, fewest, most);
}

WhatIsLeft what_is_left(const SensitivityStudy& study, const UncertainParameters& uncertain,
                        const FirstOrder& first_order, Progress& progress) {
  const std::vector<std::size_t> kept = kept_states(study.states);
  const auto points = static_cast<Eigen::Index>(study.bridge.control_points.size());
  const Eigen::MatrixXd nothing = Eigen::MatrixXd::Zero(points, 1);
  WhatIsLeft left;
  left.residuals.resize(kept.size(), {nothing, nothing});
  left.signals.resize(kept.size(), std::vector<Eigen::MatrixXd>(first_order.nominal.scenes.size()));
  if (!study.solver.make_equilibrium_solver) return left;
  const Samples samples = solve_samples(study, uncertain, first_order, progress);
  std::vector<StateErrors> of_bridges, of_epochs;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const StateResidual state(study, first_order, samples, kept[k], first_order.derivatives[k]);
    of_bridges.push_back(state.errors_of_bridges());
    of_epochs.push_back(state.errors_of_epochs());
    if (!state.stands()) continue;
    left.residuals[k] = state.shares();
    left.signals[k] = state.left_of_signals();
    warn_of(left.residuals[k], state.has_signals(), study.states[kept[k]].name, progress);
  }
  const auto bridge = joint_factors(of_bridges, points), epoch = joint_factors(of_epochs, points);
  for (std::size_t k = 0; k < kept.size(); ++k) {
    left.residuals[k].bridge = bridge[k];
    left.residuals[k].epoch = epoch[k];
  }
  return left;
}

}  // namespace voussoir
