#include "generator/scenes/proved_falls.h"

#include <algorithm>
#include <array>

#include "core/structure/neighbours.h"

namespace voussoir {

std::optional<Mechanism> fall_beside(const Scene& scene, const Model& bridge,
                                     const Coefficients& coefficients) {
  return is_one_group(scene, bridge) ? find_mechanism_beside(bridge, coefficients, scene) : std::nullopt;
}

ProvedFalls::ProvedFalls(const StartingFields& starts, const Model& bridge, const Coefficients& coefficients,
                         const PlanRules& rules, bool has_losses)
    : inherited_(rules.inherited && starts.has_pairs()), others_(!rules.collapse_fields) {
  const bool of_singles = others_ || (rules.inherited && has_losses);
  for (const auto& [scene, moving] : starts.falling(kBuilt)) {
    if (!(inherited_ || (of_singles && scene.missing() == 1))) continue;
    if (proved(scene)) continue;  // by a single within the pair
    auto mechanism = fall_beside(scene, bridge, coefficients);
    if (!mechanism) mechanism = find_mechanism(bridge, coefficients, scene, moving);
    if (mechanism) mechanisms_.emplace(scene, std::move(*mechanism));
  }
}

std::optional<Solution> ProvedFalls::of(const Scene& scene, const Model& bridge,
                                        const Coefficients& coefficients) const {
  if (!inherits(scene) && !others_) return std::nullopt;
  if (auto solution = proved_fall(mechanisms_within(scene), scene, bridge)) {
    if (inherits(scene)) solution->origin = Origin::inherited;
    return solution;
  }
  const auto own = others_ ? fall_beside(scene, bridge, coefficients) : std::nullopt;
  return own ? proved_fall(std::array{&*own}, scene, bridge) : std::nullopt;
}

bool ProvedFalls::apply_to(const Scene& scene) const {
  return (inherits(scene) || others_) && proved(scene);
}

bool ProvedFalls::proved(const Scene& scene) const {
  return std::ranges::any_of(mechanisms_within(scene),
                             [&](const Mechanism* mechanism) { return proves_fall(*mechanism, scene); });
}

std::vector<const Mechanism*> ProvedFalls::mechanisms_within(const Scene& scene) const {
  std::vector<const Mechanism*> within;
  for (const Scene& fewer : starting_subsets(scene))
    if (const auto found = mechanisms_.find(fewer); found != mechanisms_.end())
      within.push_back(&found->second);
  return within;
}

}  // namespace voussoir
