#pragma once
/// @file Scenes that are known to fall without a search: as singles or pairs within them do, or because
/// nothing can carry blocks beside the missing ones.
///
/// That a scene falls in motion does not mean that it falls with more blocks missing: where friction hardly
/// holds, the motion passes an equilibrium that another one finds. Where limit analysis proves the fall
/// (core/statics/mechanism.h), it does: fewer joints carry no more. And it does as lost, too: no forces that
/// friction allows carry what is left, whatever the joints remember.

#include <map>

#include "core/statics/mechanism.h"
#include "generator/scenes/build_plan.h"
#include "generator/scenes/start_field.h"

namespace voussoir {

/// A proof that blocks beside the missing ones fall, where these are one group: what several groups do is
/// known of scenes with fewer missing blocks. Nothing if there is none.
std::optional<Mechanism> fall_beside(const Scene& scene, const Model& bridge,
                                     const Coefficients& coefficients);

class ProvedFalls {
 public:
  ProvedFalls() = default;
  /// From what falls among the starts. Of singles if the rules want no fields of collapses, or if collapses
  /// are inherited by states after a loss, which the plan has; of singles and pairs if they are inherited and
  /// scenes start from pairs.
  ProvedFalls(const StartingFields& starts, const Model& bridge, const Coefficients& coefficients,
              const PlanRules& rules, bool has_losses);

  /// What is known of a scene that falls as built: see proved_fall. Nothing if nothing proves it, or if its
  /// field is wanted. Of three and more missing blocks, `inherited` (Origin) if the rules have it so and
  /// fewer missing blocks prove it.
  std::optional<Solution> of(const Scene& scene, const Model& bridge, const Coefficients& coefficients) const;

  /// Is anything known of the scene as built?
  bool apply_to(const Scene& scene) const;

  /// Is it proved by fewer missing blocks that no state of the scene without a load is in equilibrium?
  bool proved(const Scene& scene) const;

 private:
  bool inherits(const Scene& scene) const { return inherited_ && scene.missing() > 2; }
  std::vector<const Mechanism*> mechanisms_within(const Scene& scene) const;

  bool inherited_ = false;  ///< by scenes of three and more missing blocks
  bool others_ = false;     ///< those of fewer are not searched for either
  std::map<Scene, Mechanism> mechanisms_;
};

}  // namespace voussoir
