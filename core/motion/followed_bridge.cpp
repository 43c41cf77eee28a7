#include "core/motion/followed_bridge.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/motion/softening.h"
#include "core/structure/collapse.h"

namespace voussoir {
namespace {

constexpr double kOfCritical = 0.9;    ///< default step; the power iteration comes from below
constexpr double kDampingShare = 0.5;  ///< of the critical damping
/// Of a step that each block alone allows between neighbours that stand still a bridge allows a half and
/// more. But a thin corner gives way more the shorter a step is: there one shortens the other, down to what
/// the mass of the corner's node allows (docs/speed.md).
constexpr double kOfLeastStep = 0.4;
constexpr double kFurther = 1.1;  ///< softened so much for a step that the bridge allows at least that share
/// Of the ramp, for which motions add up: a quarter of gravity acts then. Until half of it, fields of
/// collapses would be three times as far off (docs/numerics.md).
constexpr double kEarlyShare = 1.0 / 3.0;
constexpr std::size_t kMostEarlyMemory = std::size_t{1} << 26U;  ///< [bytes] a solver

/// A shorter step, if need be, of which a whole number lies between two looks.
double step_between_looks(double step) {
  return step < kTimeBetweenLooks ? kTimeBetweenLooks / std::ceil(kTimeBetweenLooks / step) : step;
}

Pace acting_pace(const Model& model, const std::vector<BlockBody>& bodies, const DynamicSettings& settings,
                 double critical) {
  if (settings.step) {
    if (!(*settings.step > 0.0) || *settings.step > critical)
      throw InputError(
          fmt::format("a time step of {} s is not stable: the joints' stiffness against the blocks' masses "
                      "allows steps up to {:.3g} s",
                      *settings.step, critical));
    return {.step = *settings.step};
  }
  Pace pace{.step = kOfCritical * critical};
  if (settings.integrator == Integrator::implicit_blocks)
    pace = best_pace(model, bodies, settings.contact_damping, critical, kOfCritical, settings.most_parts);
  pace.step = step_between_looks(pace.step);
  return pace;
}

/// Joints softened as softened_shares says, and on until the bridge as a whole allows about such steps.
FollowedJoints followed_joints(const Model& bridge, const std::vector<BlockBody>& bodies,
                               const DynamicSettings& settings) {
  const auto critical_of = [&](const Model& model) {
    return critical_step(model, bodies, settings.integrator, settings.contact_damping);
  };
  std::vector<double> shares = softened_shares(bridge, bodies, settings);
  if (shares.empty()) return {nullptr, critical_of(bridge)};
  for (double step = settings.least_step;;) {
    auto softer = std::make_unique<Model>(softened(bridge, shares));
    const double critical = critical_of(*softer);
    if (critical >= kOfLeastStep * settings.least_step) return {std::move(softer), critical};
    step *= kFurther;
    shares = softening(bridge, bodies, settings.contact_damping, step);
  }
}

/// The pace of the blocks of a patch.
Pace pace_in(const Patch& patch, Pace pace) {
  if (pace.quick.empty()) return pace;
  const std::vector<bool> of_bridge = std::exchange(pace.quick, {});
  for (const BlockId block : patch.blocks)
    pace.quick.push_back(of_bridge[static_cast<std::size_t>(value(block))]);
  return pace;
}

}  // namespace

std::vector<double> softened_shares(const Model& bridge, const std::vector<BlockBody>& bodies,
                                    const DynamicSettings& settings) {
  if (settings.integrator != Integrator::implicit_blocks || settings.least_step == 0.0) return {};
  std::vector<double> shares = softening(bridge, bodies, settings.contact_damping, settings.least_step);
  const bool as_it_is = std::ranges::all_of(shares, [](double share) { return share == 1.0; });
  return as_it_is ? std::vector<double>{} : shares;
}

FollowedBridge::FollowedBridge(const Model& bridge_, const EquilibriumSystem& system,
                               const DynamicSettings& settings_)
    : FollowedBridge(bridge_, make_block_bodies(bridge_, settings_.inertia), system, settings_) {}

FollowedBridge::FollowedBridge(const Model& bridge_, const std::vector<BlockBody>& bodies,
                               const EquilibriumSystem& system, const DynamicSettings& settings_)
    : settings(settings_),
      joints(followed_joints(bridge_, bodies, settings)),
      bridge(joints.softer ? joints.softer.get() : &bridge_),
      natural(natural_motion(*bridge, system)),
      model(*bridge, bodies, acting_pace(*bridge, bodies, settings, joints.critical_step),
            settings.damping.value_or(2.0 * kDampingShare * natural.frequency), settings.contact_damping),
      margin(search_margin(bridge_)),
      block_size(mean_block_size(bridge_)) {}

FollowedBridge::FollowedBridge(const FollowedBridge& whole, const Patch& patch, Field carried)
    : settings(whole.settings),
      joints{nullptr, whole.joints.critical_step},
      bridge(&patch.model),
      natural(whole.natural),
      model(patch.model, make_block_bodies(patch.model, settings.inertia), pace_in(patch, whole.model.pace),
            whole.model.damping, whole.model.contact_damping),
      margin(whole.margin),
      block_size(whole.block_size) {
  model.carried = std::move(carried);
  model.carried_blocks.resize(patch.blocks.size(), false);
  for (const BlockId block : patch.rim) model.carried_blocks[static_cast<std::size_t>(value(block))] = true;
}

long FollowedBridge::steps_until(double time) const {
  return std::lround(std::ceil(time / model.step() - 1e-6));
}

long FollowedBridge::early_steps() const {
  const bool adds_up = settings.skips.early_motions && model.bonds.empty() &&
                       settings.integrator == Integrator::implicit_blocks &&
                       memory_of_early_motions(model) <= kMostEarlyMemory;
  const auto steps = static_cast<long>(kEarlyShare * settings.ramp / model.step());
  const bool is_early = 2 * steps <= steps_until(settings.moment);  // as much is followed as is left out
  return adds_up && is_early ? steps : 0;
}

double FollowedBridge::moved_away(const DecisionRules& rules) const {
  return voussoir::moved_away(rules, natural.sag, block_size);
}

}  // namespace voussoir
