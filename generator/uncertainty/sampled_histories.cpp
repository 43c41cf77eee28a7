#include "generator/uncertainty/sampled_histories.h"

#include "core/solve/settling.h"

namespace voussoir {

SampledBridge draw_bridge(const Model& bridge, const UncertainParameters& uncertain, std::uint64_t seed) {
  const auto of_bridge = static_cast<Eigen::Index>(uncertain.of_bridge.size());
  const auto of_epoch = static_cast<Eigen::Index>(uncertain.of_epoch.size());
  const Eigen::VectorXd theta = sampled_theta(static_cast<std::size_t>(of_bridge + of_epoch), seed);
  const Eigen::VectorXd parameters = uncertain.correlation_factor * theta.head(of_bridge);
  return {.of_bridge = parameters,
          .of_epoch = theta.tail(of_epoch),
          .parameters = parameters_at(bridge, uncertain, parameters),
          .epoch = in_epoch({}, bridge, uncertain, theta.tail(of_epoch)),
          .slowly = seed % 2 == 0};
}

std::vector<SampledScene> SampledHistories::solve(std::span<const SampledBridge> bridges,
                                                  const std::vector<std::size_t>& scenes) const {
  std::vector<Case> cases;
  for (const SampledBridge& bridge : bridges) {
    const std::size_t intact = cases.size();
    for (const std::size_t scene : scenes) cases.push_back({&bridge, scene, intact});
  }
  const std::vector<Solution> nothing(study_.states.size());
  Found at_rest(cases.size(), nothing), in_epoch(cases.size(), nothing);
  build_intact(cases, at_rest);
  build_others(cases, at_rest);
  enter_epochs(cases, at_rest, in_epoch);
  go_on(cases, false, at_rest);
  go_on(cases, true, in_epoch);
  std::vector<SampledScene> result;
  for (std::size_t i = 0; i < cases.size(); ++i)
    result.push_back({settled(at_rest[i]), settled(in_epoch[i])});
  return result;
}

/// Each from rest, as if it were alone: near the nominal bridge's field there may be an equilibrium where
/// friction holds what no history leads to.
void SampledHistories::build_intact(const std::vector<Case>& cases, Found& found) const {
  Batch batch;
  for (std::size_t i = 0; i < cases.size(); ++i)
    if (cases[i].scene == kIntactScene)
      batch.add(i, {.stage = {}, .parameters = &cases[i].bridge->parameters});
  std::vector<Solution> built = settle(batch.tasks, equilibrium_(batch.tasks), equilibrium_);
  for (std::size_t k = 0; k < built.size(); ++k) {
    const std::size_t i = batch.places[k];
    found[i][kBuilt] = stands(built[k]) ? std::move(built[k]) : set_in_motion(*cases[i].bridge);
  }
}

/// From the intact bridge, with what that has slid.
void SampledHistories::build_others(const std::vector<Case>& cases, Found& found) const {
  Batch batch;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Case& one = cases[i];
    const Solution& intact = found[one.intact][kBuilt];
    if (one.scene == kIntactScene || !stands(intact)) continue;
    batch.add(i, {.stage = {.scene = scenes_[one.scene]},
                  .start = &intact.displacement,
                  .slipped = has_slipped(intact) ? &intact.slipped : nullptr,
                  .parameters = &one.bridge->parameters});
  }
  solve(batch, kBuilt, found);
}

Solution SampledHistories::set_in_motion(const SampledBridge& bridge) const {
  const Model model = with_parameters(study_.bridge, bridge.parameters);
  const StageSolver solver = bridge.slowly ? study_.solver.make_slow_solver(model)
                                           : study_.solver.make_solver(model, study_.settings);
  const StageTask intact{.stage = {.scene = {}}};
  return solver({&intact, 1}).front();
}

void SampledHistories::enter_epochs(const std::vector<Case>& cases, const Found& at_rest,
                                    Found& found) const {
  for (std::size_t i = 0; i < cases.size(); ++i) found[i][kBuilt] = at_rest[i][kBuilt];
  for (int part = 1; part <= kPartsOfEpoch; ++part) {
    const bool is_for_all = part % (kPartsOfEpoch / kPartsOfEpochWithout) == 0;
    Batch batch;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      if (cases[i].scene != kIntactScene && !is_for_all) continue;
      Stage epoch = on_the_way({}, cases[i].bridge->epoch, static_cast<double>(part) / kPartsOfEpoch);
      batch.add_next(i, stage_of(cases[i], std::move(epoch)), found[i][kBuilt], cases[i].bridge->parameters);
    }
    solve(batch, kBuilt, found);
  }
}

/// The states after `built`.
void SampledHistories::go_on(const std::vector<Case>& cases, bool in_epoch, Found& found) const {
  for (std::size_t state = kBuilt + 1; state < study_.states.size(); ++state) {
    const PlannedState& planned = study_.states[state];
    Batch batch;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const Case& one = cases[i];
      if (planned.is_loss() && one.scene == kIntactScene) {
        found[i][state] = found[i][kBuilt];
        continue;
      }
      Stage stage = stage_of(one, in_epoch ? one.bridge->epoch : Stage{});
      stage.load = planned.load;
      batch.add_next(i, std::move(stage),
                     planned.is_loss() ? found[one.intact][kBuilt] : found[i][*planned.before],
                     one.bridge->parameters);
    }
    solve(batch, state, found);
  }
}

Stage SampledHistories::stage_of(const Case& one, Stage conditions) const {
  conditions.scene = scenes_[one.scene];
  return conditions;
}

void SampledHistories::Batch::add(std::size_t place, StageTask&& task) {
  places.push_back(place);
  tasks.push_back(std::move(task));
}

void SampledHistories::Batch::add_next(std::size_t place, Stage&& stage, const Solution& before,
                                       const Parameters& parameters) {
  if (stands(before))
    add(place, {.stage = std::move(stage),
                .start = &before.displacement,
                .before = &before,
                .parameters = &parameters});
}

void SampledHistories::solve(const Batch& batch, std::size_t state, Found& found) const {
  std::vector<Solution> solutions = equilibrium_(batch.tasks);
  for (std::size_t k = 0; k < batch.places.size(); ++k)
    found[batch.places[k]][state] = std::move(solutions[k]);
}

Settled SampledHistories::settled(const std::vector<Solution>& states) const {
  Settled result;
  for (const Solution& solution : states)
    result.push_back(stands(solution) ? readings_at(study_.bridge.control_points, solution.displacement)
                                      : Eigen::VectorXd());
  return result;
}

}  // namespace voussoir
