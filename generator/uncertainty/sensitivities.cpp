#include "generator/uncertainty/sensitivities.h"

#include <oneapi/tbb/enumerable_thread_specific.h>

#include <algorithm>

#include "core/simd/column_products.h"
#include "database/records/order_of_sums.h"
#include "generator/running/parallel.h"
#include "generator/scenes/scene_list.h"
#include "generator/uncertainty/first_order_residual.h"
#include "generator/uncertainty/load_influence.h"
#include "generator/uncertainty/scene_derivatives.h"
#include "generator/uncertainty/uncertain_falls.h"
#include "generator/uncertainty/unevenness.h"

namespace voussoir {
namespace {

/// Intact, and the singles of the list, in their order.
std::vector<Scene> studied_scenes(const std::vector<Scene>& scenes) {
  std::vector<Scene> studied = {Scene{}};
  std::ranges::copy_if(scenes, std::back_inserter(studied),
                       [](const Scene& scene) { return scene.missing() == 1; });
  return in_order(std::move(studied));
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
    solving.solve_from_intact(study.solver.make_solver(study.bridge, study.settings), groups);
  }
  std::vector<SceneStates> states;
  for (SceneGroup& group : groups) states.push_back(std::move(group.states));
  return states;
}

/// Of each kept state and each scene.
Derivatives derivatives_of(const SensitivityStudy& study, const SensitivityEquations& equations,
                           const std::vector<Scene>& scenes, const std::vector<SceneStates>& states,
                           Progress& progress) {
  const std::vector<std::size_t> kept = kept_states(study.states);
  Derivatives derivatives(kept.size(), std::vector<Eigen::MatrixXd>(scenes.size()));
  oneapi::tbb::enumerable_thread_specific<SceneDerivatives> workers(
      [&] { return SceneDerivatives(study, equations); });
  progress.start(scenes.size(), 0, "scenes' sensitivities");
  Crew(study.threads).for_each_index(scenes.size(), [&](std::size_t i) {
    SceneDerivatives& worker = workers.local();
    for (std::size_t state = 0; state < kept.size(); ++state)
      derivatives[state][i] = worker.of(scenes[i], kept[state], states[i], states.front());
    progress.advance(1);
  });
  progress.finish();
  return derivatives;
}

/// A scene's derivatives by the directions of the basis: points x directions.
Eigen::MatrixXd projected(const Eigen::MatrixXd& scene, const Eigen::MatrixXd& basis) {
  const Eigen::MatrixXd filled = filled_up(scene.leftCols(basis.rows()));
  Eigen::MatrixXd result(filled.rows(), basis.cols());
  project_columns(filled.data(), static_cast<std::size_t>(filled.cols()), basis.data(),
                  static_cast<std::size_t>(basis.cols()), static_cast<std::size_t>(filled.rows()),
                  result.data());
  return result.topRows(scene.rows());
}

}  // namespace

std::optional<Sensitivities> find_sensitivities(const SensitivityStudy& study,
                                                const std::vector<Scene>& scenes, const KnownRecords& known,
                                                Progress& progress) {
  fix_order_of_sums();
  const SensitivityEquations equations(study.bridge,
                                       uncertain_parameters(study.bridge, study.description.uncertainty));
  Sensitivities result;
  result.parameters = equations.uncertain.all();
  if (result.parameters.empty()) return std::nullopt;
  result.scenes = studied_scenes(scenes);
  const std::vector<SceneStates> states = states_of(study, result.scenes, known);
  const std::optional<Solution>& intact = states.front()[kBuilt];
  if (!intact || !stands(*intact)) return std::nullopt;
  auto derivatives = derivatives_of(study, equations, result.scenes, states, progress);
  const FirstOrder first_order{{result.scenes, states}, derivatives};
  WhatIsLeft left = what_is_left(study, equations.uncertain, first_order, progress);
  const std::vector<SampledFall> falls =
      find_uncertain_falls(study, equations.uncertain, first_order, progress);
  for (const SampledFall& one : falls) derivatives[one.state][one.scene] = one.derivatives;
  const auto of_bridge = static_cast<Eigen::Index>(equations.uncertain.of_bridge.size());
  result.basis = sensitivity_basis(derivatives, equations.uncertain.correlation_factor, study.threads);
  result.make_room(derivatives.size(), static_cast<Eigen::Index>(study.bridge.control_points.size()),
                   Eigen::Index{kBridgesWithSingles});
  result.residuals = std::move(left.residuals);
  result.unevenness = find_unevenness(study, states.front());
  result.load = find_load_influence(study, equations, states.front());
  Crew(study.threads).for_each_index(result.scenes.size(), [&](std::size_t i) {
    for (std::size_t state = 0; state < derivatives.size(); ++state) {
      const Eigen::MatrixXd scene = std::move(derivatives[state][i]);
      if (scene.size() > 0)
        result.set(state, i,
                   SceneFactors{projected(scene, result.basis), scene.rightCols(scene.cols() - of_bridge),
                                std::move(left.signals[state][i])});
    }
  });
  for (const SampledFall& one : falls) result.set_fall(one.state, one.scene, one.fall);
  return result;
}

}  // namespace voussoir
