#include "generator/uncertainty/uncertain_falls.h"

#include <algorithm>

#include "generator/running/parallel.h"
#include "generator/scenes/proved_falls.h"
#include "generator/uncertainty/scene_derivatives.h"

namespace voussoir {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Each joint as rough as in the roughest of the bridges: what falls there falls in all of them, as their
/// blocks' weights differ by one factor alone.
Model as_rough_as_any(Model bridge, const std::vector<SampledBridge>& sampled) {
  for (const SampledBridge& other : sampled)
    for (std::size_t j = 0; j < bridge.parameters.joints.size(); ++j) {
      double& angle = bridge.parameters.joints[j].friction_angle;
      angle = std::max(angle, other.parameters.joints[j].friction_angle);
    }
  return bridge;
}

/// The kept states in which the nominal bridge does not stand without these blocks, but does with them.
/// Unresolved ones, too.
std::vector<std::size_t> states_of_falls(const std::vector<std::size_t>& kept, const FirstOrder& first_order,
                                         std::size_t scene) {
  std::vector<std::size_t> falls;
  for (std::size_t state = 0; state < kept.size(); ++state) {
    const std::optional<Solution>& solution = first_order.nominal.states[scene][kept[state]];
    const bool intact_stands = first_order.derivatives[state][kIntactScene].size() > 0;
    if (intact_stands && !(solution && stands(*solution))) falls.push_back(state);
  }
  return falls;
}

/// The intact scene, and those that fall in some kept state, unless limit analysis proves that they fall in
/// each of the bridges. Places among the nominal bridge's scenes.
std::vector<std::size_t> scenes_that_may_stand(const SensitivityStudy& study, const FirstOrder& first_order,
                                               const std::vector<SampledBridge>& sampled) {
  const Model rough = as_rough_as_any(study.bridge, sampled);
  const EquilibriumSystem system(rough);
  const Coefficients coefficients(system, rough.parameters);
  const std::vector<std::size_t> kept = kept_states(study.states);
  std::vector<std::size_t> places = {kIntactScene};
  for (std::size_t scene = 1; scene < first_order.nominal.scenes.size(); ++scene) {
    if (states_of_falls(kept, first_order, scene).empty()) continue;
    const Scene& lost = first_order.nominal.scenes[scene];
    const std::vector<BlockId>& moving = first_order.nominal.states[scene][kBuilt]->moving;
    const bool always = fall_beside(lost, rough, coefficients) ||
                        (!moving.empty() && find_mechanism(rough, coefficients, lost, moving));
    if (!always) places.push_back(scene);
  }
  return places;
}

/// What one sampled bridge shows at rest, of each kept state and scene; empty where it does not stand, or not
/// even the intact one.
struct ShownAtRest {
  std::vector<std::vector<VectorXd>> readings;
  std::vector<std::vector<MatrixXd>> slopes;  ///< points x parameters
};

/// Its states are found as those of a nominal bridge are.
ShownAtRest at_rest(const SensitivityStudy& nominal, const std::vector<Scene>& scenes,
                    const SampledBridge& sampled) {
  const Model bridge = with_parameters(nominal.bridge, sampled.parameters);
  const SensitivityStudy study{nominal.description, bridge, nominal.states, nominal.solver, nominal.settings};
  const std::vector<SceneStates> states =
      StateSolving(bridge, study.states)
          .states_from_intact(study.solver.make_solver(bridge, study.settings), scenes);
  const SensitivityEquations equations(bridge, uncertain_parameters(bridge, study.description.uncertainty));
  SceneDerivatives derivatives(study, equations);
  ShownAtRest shown;
  for (const std::size_t state : kept_states(study.states)) {
    std::vector<VectorXd>& readings = shown.readings.emplace_back(scenes.size());
    std::vector<MatrixXd>& slopes = shown.slopes.emplace_back(scenes.size());
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      if (i > kIntactScene && slopes[kIntactScene].size() == 0) break;
      slopes[i] = derivatives.of(scenes[i], state, states[i], states.front());
      if (slopes[i].size() > 0)
        readings[i] = readings_at(bridge.control_points, states[i][state]->displacement);
    }
  }
  return shown;
}

std::vector<ShownAtRest> all_at_rest(const SensitivityStudy& study, const std::vector<Scene>& scenes,
                                     const std::vector<SampledBridge>& sampled, Progress& progress) {
  std::vector<ShownAtRest> shown(sampled.size());
  progress.start(sampled.size(), 0, "sampled bridges that may stand");
  Crew(study.threads).for_each_index(sampled.size(), [&](std::size_t i) {
    shown[i] = at_rest(study, scenes, sampled[i]);
    progress.advance(1);
  });
  progress.finish();
  return shown;
}

VectorXd zero_where_lost(const VectorXd& readings) {
  return readings.array().isNaN().select(0.0, readings);
}

/// Those in which the scene stands, by their numbers.
std::vector<std::size_t> standing_bridges(const std::vector<ShownAtRest>& shown, std::size_t state,
                                          std::size_t scene) {
  std::vector<std::size_t> bridges;
  for (std::size_t i = 0; i < shown.size(); ++i)
    if (shown[i].slopes[state][scene].size() > 0) bridges.push_back(i);
  return bridges;
}

/// On average over the bridges in which the scene stands.
SampledFall average(const std::vector<SampledBridge>& sampled, const std::vector<ShownAtRest>& shown,
                    const std::vector<std::size_t>& standing, std::size_t state, std::size_t scene) {
  const std::size_t intact = standing_bridges(shown, state, kIntactScene).size();
  const auto count = static_cast<double>(standing.size());
  const MatrixXd& first = shown[standing.front()].slopes[state][scene];
  MatrixXd slope = MatrixXd::Zero(first.rows(), first.cols());
  for (const std::size_t i : standing) slope += shown[i].slopes[state][scene] / count;
  VectorXd readings = VectorXd::Zero(first.rows());
  for (const std::size_t i : standing) {
    const VectorXd& theta = sampled[i].of_bridge;
    const VectorXd& here = shown[i].readings[state][scene];
    readings += (zero_where_lost(here) - slope.leftCols(theta.size()) * theta) / count;
  }
  return {.state = state,
          .fall = {count / static_cast<double>(intact), std::move(readings)},
          .derivatives = std::move(slope)};
}

}  // namespace

std::vector<SampledFall> find_uncertain_falls(const SensitivityStudy& study,
                                              const UncertainParameters& uncertain,
                                              const FirstOrder& first_order, Progress& progress) {
  if (!study.solver.make_equilibrium_solver || uncertain.of_bridge.empty()) return {};
  std::vector<SampledBridge> sampled;
  for (std::size_t i = 0; i < kBridgesOfFalls; ++i)
    sampled.push_back(draw_bridge(study.bridge, uncertain, kFirstSampledSeed + i));
  const std::vector<std::size_t> places = scenes_that_may_stand(study, first_order, sampled);
  if (places.size() < 2) return {};
  std::vector<Scene> scenes;
  for (const std::size_t place : places) scenes.push_back(first_order.nominal.scenes[place]);

  const std::vector<ShownAtRest> shown = all_at_rest(study, scenes, sampled, progress);
  const std::vector<std::size_t> kept = kept_states(study.states);
  std::vector<SampledFall> found;
  for (std::size_t i = 1; i < scenes.size(); ++i)
    for (const std::size_t state : states_of_falls(kept, first_order, places[i])) {
      const std::vector<std::size_t> standing = standing_bridges(shown, state, i);
      if (standing.empty()) continue;
      found.push_back(average(sampled, shown, standing, state, i));
      found.back().scene = places[i];
    }
  return found;
}

}  // namespace voussoir
