#include "core/structure/mortar_regions.h"

#include <algorithm>

#include "core/error.h"
#include "core/structure/halved_blocks.h"

namespace voussoir {
namespace {

bool lies_in(const MortarRegion& region, const Block& first, const Block& second) {
  const auto& names = region.between;
  if (names.empty()) return true;
  return (is_called(first, names[0]) && is_called(second, names[1])) ||
         (is_called(first, names[1]) && is_called(second, names[0]));
}

}  // namespace

void lay_mortar(const BridgeDescription& description, const Structure& structure, Parameters& parameters) {
  const BlockLayout& layout = structure.layout;
  for (const MortarRegion& region : description.mortar)
    layout.expect("between in [[mortar]]", region.between);
  const bool held_together = std::ranges::any_of(description.mortar, &MortarRegion::within_blocks);
  if (description.wall.halved && !held_together)
    throw InputError("halved in [wall]: expected a table [[mortar]] with within_blocks = true beside it");
  for (std::size_t j = 0; j < structure.joints.size(); ++j) {
    const Block& first = layout[structure.joints[j].first];
    const Block& second = layout[structure.joints[j].second];
    const bool within = are_halves(first, second, description.wall);
    for (const MortarRegion& region : description.mortar) {
      if (region.within_blocks != within || !lies_in(region, first, second)) continue;
      JointMaterial& joint = parameters.joints[j];
      joint.mortar = region.mortar;
      joint.normal_stiffness = region.normal_stiffness.value_or(description.joints.normal_stiffness);
      joint.tangential_stiffness =
          region.tangential_stiffness.value_or(description.joints.tangential_stiffness);
    }
  }
}

}  // namespace voussoir
