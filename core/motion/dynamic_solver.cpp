#include "core/motion/dynamic_solver.h"

#include <algorithm>

#include "core/motion/followed_bridge.h"
#include "core/motion/motion_run.h"
#include "core/not_a_number.h"

namespace voussoir {

DynamicSettings acting_settings(DynamicSettings settings, const Model& model) {
  if (!has_mortar(model.parameters)) return settings;
  settings.most_parts = 1;
  settings.least_step = 0.0;
  return settings;
}

bool softens_joints(const DynamicSettings& settings, const Model& model) {
  const DynamicSettings acting = acting_settings(settings, model);
  return !softened_shares(model, make_block_bodies(model, acting.inertia), acting).empty();
}

DynamicSolver::DynamicSolver(const Model& model, DynamicSettings settings)
    : DynamicSolver(model, EquilibriumSystem(model), settings) {}

DynamicSolver::DynamicSolver(const Model& model, const EquilibriumSystem& system, DynamicSettings settings)
    : followed_(std::make_unique<FollowedBridge>(model, system, acting_settings(settings, model))) {}
DynamicSolver::~DynamicSolver() = default;
DynamicSolver::DynamicSolver(DynamicSolver&&) noexcept = default;
DynamicSolver& DynamicSolver::operator=(DynamicSolver&&) noexcept = default;

std::vector<DynamicSolution> DynamicSolver::solve(std::span<const Scene> scenes, const DecisionRules& rules,
                                                  std::span<const MotionStart> starts) {
  FollowedBridge& shared = *followed_;
  const std::vector<MotionStart> all_at_rest(starts.empty() ? scenes.size() : 0, MotionStart::at_rest);
  if (starts.empty()) starts = all_at_rest;
  const long early_steps = shared.early_steps();
  std::vector<Scene> early;
  for (std::size_t i = 0; i < scenes.size() && early_steps > 0; ++i)
    if (starts[i] == MotionStart::from_singles) early.push_back(scenes[i]);
  if (const std::vector<Scene> lacking = shared.early.lacking(early); !lacking.empty()) {
    const std::vector<MotionStart> at_rest(lacking.size(), MotionStart::at_rest);
    shared.early.add(lacking, on_lanes(shared, rules, lacking, at_rest,
                                       [&](auto&& run) { return run.snapshots_after(early_steps); }));
  }
  return on_lanes(shared, rules, scenes, starts, [](auto&& run) { return run.run(); });
}

std::vector<DynamicSolution> DynamicSolver::solve(std::span<const Scene> scenes) {
  return solve(scenes, followed_->settings.decision);
}

DynamicSolution DynamicSolver::solve(const Scene& scene) {
  return std::move(solve(std::span(&scene, 1)).front());
}

Patch DynamicSolver::patch_around(const Scene& scene, int neighbours) const {
  return voussoir::patch_around(scene, neighbours, *followed_->bridge);
}

Solution DynamicSolver::solve_in(const Patch& patch, const Scene& scene, const Field& surroundings,
                                 const DecisionRules& rules) const {
  const FollowedBridge near(*followed_, patch, patch.field_of(surroundings));
  const std::vector<Scene> scenes = {patch.scene_of(scene)};
  const std::vector<MotionStart> at_rest = {MotionStart::at_rest};
  Solution found = std::move(
      on_lanes(near, rules, scenes, at_rest, [](auto&& run) { return run.run(); }).front().solution);
  for (BlockId& block : found.moving) block = patch.blocks[static_cast<std::size_t>(value(block))];
  found.residual *= near.model.weight / followed_->model.weight;
  found.displacement = Field::Constant(2, followed_->bridge->mesh.node_count(), kNan);
  found.slipped = {};
  return found;
}

bool DynamicSolver::softens_joints() const {
  return followed_->joints.softer != nullptr;
}

const Pace& DynamicSolver::pace() const {
  return followed_->model.pace;
}
double DynamicSolver::step() const {
  return pace().step;
}
double DynamicSolver::critical_step() const {
  return followed_->joints.critical_step;
}
double DynamicSolver::frequency() const {
  return followed_->natural.frequency;
}
double DynamicSolver::damping() const {
  return followed_->model.damping;
}
double DynamicSolver::sag() const {
  return followed_->natural.sag;
}
double DynamicSolver::moved_away(const DecisionRules& rules) const {
  return followed_->moved_away(rules);
}

}  // namespace voussoir
