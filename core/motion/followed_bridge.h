#pragma once
/// @file A bridge, or a patch of it, with what the motions of all its scenes share.

#include <memory>

#include "core/motion/dynamic_solver.h"
#include "core/motion/early_motion.h"
#include "core/structure/patch.h"

namespace voussoir {

inline constexpr double kTimeBetweenLooks = 0.01;  ///< [s] between two looks at a scene

/// For each block the share of its joints' stiffness that steps of the settings can follow; empty if all can
/// be followed as they are.
std::vector<double> softened_shares(const Model& bridge, const std::vector<BlockBody>& bodies,
                                    const DynamicSettings& settings);

struct FollowedJoints {
  std::unique_ptr<Model> softer;  ///< the bridge with softer joints; null: they are followed as they are
  double critical_step = 0.0;     ///< [s] with them
};

struct FollowedBridge {
  /// `system`: of the bridge, which must outlive this. Throws InputError for a step above the critical one.
  FollowedBridge(const Model& bridge, const EquilibriumSystem& system, const DynamicSettings& settings);

  /// A patch of the bridge that `whole` follows. It has the steps, damping and sag of the whole: what holds
  /// its rim makes no frequency higher. The rim moves to `carried` (2 x nodes of the patch) as gravity grows.
  FollowedBridge(const FollowedBridge& whole, const Patch& patch, Field carried);

  /// Steps until a time has come, but for round-off.
  long steps_until(double time) const;

  /// After so many steps a scene is followed on its own, if it starts from its singles. 0: none does, as
  /// bonds remember more than a snapshot has, or there are too many snapshots.
  long early_steps() const;

  /// From so far on blocks have moved away [m].
  double moved_away(const DecisionRules& rules) const;

  DynamicSettings settings;
  FollowedJoints joints;
  const Model* bridge;  ///< what is followed
  NaturalMotion natural;
  MotionModel model;
  double margin;      ///< search_margin
  double block_size;  ///< [m]
  EarlyMotions early;

 private:
  FollowedBridge(const Model& bridge, const std::vector<BlockBody>& bodies, const EquilibriumSystem& system,
                 const DynamicSettings& settings);
};

}  // namespace voussoir
