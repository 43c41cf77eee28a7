#pragma once
/// @file Scenes in motion: gravity grows on the bridge without the scene's blocks, and what happens decides
/// the outcome.

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/motion/block_dynamics.h"
#include "core/motion/decision_rules.h"
#include "core/motion/pace.h"
#include "core/statics/skips.h"
#include "core/statics/solution.h"
#include "core/structure/patch.h"

namespace voussoir {

struct FollowedBridge;

/// Times in seconds of the bridge's own time.
struct DynamicSettings {
  Integrator integrator = Integrator::implicit_blocks;
  RotationalInertia inertia = RotationalInertia::lumped;
  std::optional<double> step;  ///< of all blocks; empty: 0.9 times the critical step, and for most blocks
                               ///< several times that (pace.h)
  int most_parts = 8;        ///< so many times it at most where `step` is empty; 1: all blocks take the same
                             ///< implicit steps
  double least_step = 2e-4;  ///< joints of a block that alone would need shorter implicit steps are softened
                             ///< until it does not (softening.h), and on until the bridge needs none much
                             ///< shorter; 0: none are
  double ramp = 0.3;         ///< gravity grows from 0 as 3 x^2 - 2 x^3, x = time / ramp; 0: at once
  std::optional<double>
      damping;  ///< force per mass and velocity [1/s]; empty: half-critical of the lowest frequency
  double contact_damping = 1e-4;  ///< joints resist what they will see this much later
  double moment = 0.3;            ///< of the field of a scene that collapses
  DecisionRules decision{};
  Skips skips{};
  int side_by_side = 4;  ///< scenes at a time: 1 or 4; the answers have the same bits
};

/// The settings that act on this model: bonds of mortar are followed in one pace, as stiff as they are.
DynamicSettings acting_settings(DynamicSettings settings, const Model& model);

/// Does a motion with these settings follow softer joints than the model has (softening.h)?
bool softens_joints(const DynamicSettings& settings, const Model& model);

/// What happened to a scene in motion.
struct DynamicSolution {
  Solution solution;  ///< `residual` is the sum of the blocks' resultant forces over the bridge's weight;
                      ///< `iterations` counts time steps; the field of a collapse is the one at `time`;
                      ///< `slipped` is what joints have slipped where it does not fall
  double time = 0.0;  ///< of the field [s]
  double kinetic_energy = 0.0;  ///< at the decision [J]
};

/// How scenes begin to move.
enum class MotionStart {
  at_rest,
  from_singles  ///< where the motions of their missing blocks, each missing alone, add up to after a third of
                ///< the ramp (early_motion.h); at rest where the solver cannot or is not to skip that
};

/// Follows scenes of one variant, several side by side; lanes that finish early take the next scene. A
/// solution depends on its scene and start only, to the last bit. Not thread-safe: one solver a thread. The
/// model must outlive the solver.
class DynamicSolver {
 public:
  /// Throws InputError for a step above the critical one.
  explicit DynamicSolver(const Model& model, DynamicSettings settings = {});

  /// The same with equations of the model's structure that are there already.
  DynamicSolver(const Model& model, const EquilibriumSystem& system, DynamicSettings settings);
  ~DynamicSolver();
  DynamicSolver(DynamicSolver&&) noexcept;
  DynamicSolver& operator=(DynamicSolver&&) noexcept;

  /// Outcomes, in the scenes' order.
  std::vector<DynamicSolution> solve(std::span<const Scene> scenes);

  /// The same, decided by other rules, each scene with its own start (none given: at rest).
  std::vector<DynamicSolution> solve(std::span<const Scene> scenes, const DecisionRules& rules,
                                     std::span<const MotionStart> starts = {});

  DynamicSolution solve(const Scene& scene);

  /// voussoir::patch_around of the bridge with the joints that motion follows.
  Patch patch_around(const Scene& scene, int neighbours) const;

  /// What becomes of a scene in a patch around its missing blocks, whose rim goes to where it is in
  /// `surroundings` (2 x nodes of the bridge) as gravity grows; in implicit steps only. Without a field;
  /// `moving` are blocks of the bridge.
  Solution solve_in(const Patch& patch, const Scene& scene, const Field& surroundings,
                    const DecisionRules& rules) const;

  bool softens_joints() const;  ///< does it follow softer joints than the bridge has (softening.h)?
  const Pace& pace() const;
  double step() const;                                  ///< of most blocks [s]
  double critical_step() const;                         ///< of all blocks [s]
  double frequency() const;                             ///< the lowest of the bonded bridge [rad/s]
  double damping() const;                               ///< [1/s]
  double sag() const;                                   ///< of the bonded bridge [m]
  double moved_away(const DecisionRules& rules) const;  ///< how far blocks move that have [m]

 private:
  std::unique_ptr<FollowedBridge> followed_;
};

}  // namespace voussoir
