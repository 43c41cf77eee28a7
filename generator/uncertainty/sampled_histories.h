#pragma once
/// @file Bridges that are drawn at random, brought to rest and then into an epoch of their own.

#include "core/structure/uncertain_parameters.h"
#include "generator/scenes/state_solving.h"
#include "generator/uncertainty/sensitivities.h"

namespace voussoir {

/// Parts in which a bridge warms and its supports move into an epoch: joints slide on the way. In one part
/// the reference bridge's displacements are off by 20 micrometres (root mean square, of a change of 1130), in
/// four by 0.5; those of a bridge that stands by what it has slid (seed 1059) by 105 and 18 (of 1000).
inline constexpr int kPartsOfEpoch = 4;
/// And scenes that lack a block, of which there are many and which show no more than what is left of their
/// signals: two parts are off by 0.8 micrometres.
inline constexpr int kPartsOfEpochWithout = 2;
static_assert(kPartsOfEpoch % kPartsOfEpochWithout == 0);

/// A bridge that is drawn at random, and an epoch.
struct SampledBridge {
  Eigen::VectorXd of_bridge, of_epoch;  ///< theta
  Parameters parameters;
  Stage epoch;
  bool slowly;  ///< loaded slowly where it must be set in motion
};

SampledBridge draw_bridge(const Model& bridge, const UncertainParameters& uncertain, std::uint64_t seed);

/// What the control points of a scene have moved in each state of the plan [m]; empty where it does not
/// stand.
using Settled = std::vector<Eigen::VectorXd>;

struct SampledScene {
  Settled at_rest;   ///< at the temperature and with the supports of the file
  Settled in_epoch;  ///< where the epoch begins after the scene was built and before blocks go or loads come
};

/// The place of the intact bridge among all scenes that are sampled.
inline constexpr std::size_t kIntactScene = 0;

/// Solves scenes of sampled bridges. One a thread; what is given outlives it. The solver can find equilibria
/// alone (SolverChoice).
class SampledHistories {
 public:
  SampledHistories(const SensitivityStudy& study, const std::vector<Scene>& scenes)
      : study_(study), scenes_(scenes), equilibrium_(study.solver.make_equilibrium_solver(study.bridge)) {}

  /// Of each bridge these scenes (places in all of them, the intact one first), one after the other.
  ///
  /// Every intact bridge is found as if it were alone: from rest, in motion if there is no equilibrium in
  /// which nothing has slipped, and where it settles (core/solve/settling.h). Near the nominal bridge's field
  /// there may be an equilibrium that no history leads to: those of random bridge 5000 are up to 3.6 mm of 4
  /// away.
  std::vector<SampledScene> solve(std::span<const SampledBridge> bridges,
                                  const std::vector<std::size_t>& scenes) const;

 private:
  /// A scene of a sampled bridge.
  struct Case {
    const SampledBridge* bridge;
    std::size_t scene;
    std::size_t intact;  ///< the case of the same bridge without missing blocks
  };
  using Found = std::vector<std::vector<Solution>>;  ///< of each case and state

  /// Stages of some of the cases, solved side by side.
  struct Batch {
    std::vector<StageTask> tasks;
    std::vector<std::size_t> places;  ///< of their cases

    void add(std::size_t place, StageTask&& task);
    /// Nothing if what comes before does not stand.
    void add_next(std::size_t place, Stage&& stage, const Solution& before, const Parameters& parameters);
  };

  void build_intact(const std::vector<Case>& cases, Found& found) const;
  void build_others(const std::vector<Case>& cases, Found& found) const;
  void enter_epochs(const std::vector<Case>& cases, const Found& at_rest, Found& found) const;
  void go_on(const std::vector<Case>& cases, bool in_epoch, Found& found) const;
  Solution set_in_motion(const SampledBridge& bridge) const;
  Stage stage_of(const Case& one, Stage conditions) const;
  void solve(const Batch& batch, std::size_t state, Found& found) const;
  Settled settled(const std::vector<Solution>& states) const;

  const SensitivityStudy& study_;
  const std::vector<Scene>& scenes_;
  StageSolver equilibrium_;
};

}  // namespace voussoir
