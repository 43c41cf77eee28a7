#include "generator/proved_falls.h"

#include <algorithm>

namespace voussoir {

ProvedFalls::ProvedFalls(const StartingFields& starts, const Model& bridge, const Coefficients& coefficients,
                         const PlanRules& rules)
    : inherited_(rules.inherited && starts.has_pairs()), others_(!rules.collapse_fields) {
  for (const auto& [scene, moving] : starts.falling(kBuilt)) {
    if (!(inherited_ || (others_ && scene.missing() == 1))) continue;
    if (proved(scene, bridge)) continue;  // by a single within the pair
    if (auto mechanism = find_mechanism(bridge, coefficients, scene, moving))
      mechanisms_.emplace(scene, std::move(*mechanism));
  }
}

std::optional<Solution> ProvedFalls::of(const Scene& scene, const Structure& structure) const {
  const bool inherits = inherited_ && scene.missing() > 2;
  auto solution = inherits || others_ ? proved(scene, structure) : std::nullopt;
  if (solution && inherits) solution->origin = Origin::inherited;
  return solution;
}

std::optional<Solution> ProvedFalls::proved(const Scene& scene, const Structure& structure) const {
  std::vector<const Mechanism*> within;
  for (const Scene& fewer : starting_subsets(scene))
    if (const auto found = mechanisms_.find(fewer); found != mechanisms_.end())
      within.push_back(&found->second);
  return proved_fall(within, scene, structure);
}

}  // namespace voussoir
