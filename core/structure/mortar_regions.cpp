#include "core/structure/mortar_regions.h"

#include <algorithm>

#include "core/error.h"
#include "core/structure/halved_blocks.h"

namespace voussoir {
namespace {

bool is_called(const Block& block, const std::string& name) {
  return block.label == name || name == name_of(block.role);
}

bool lies_in(const MortarRegion& region, const Block& first, const Block& second) {
  const auto& names = region.between;
  if (names.empty()) return true;
  return (is_called(first, names[0]) && is_called(second, names[1])) ||
         (is_called(first, names[1]) && is_called(second, names[0]));
}

bool is_role(const std::string& name) {
  return std::ranges::find(kRoleNames, name) != kRoleNames.end();
}

void check_names(const MortarRegion& region, const BlockLayout& layout) {
  for (const std::string& name : region.between)
    if (!is_role(name) && !layout.find_label(name))
      throw InputError(
          fmt::format("between in [[mortar]]: '{}' is no block: expected a label of a block or one of {}",
                      name, fmt::join(kRoleNames, ", ")));
}

}  // namespace

void lay_mortar(const BridgeDescription& description, const Structure& structure, Parameters& parameters) {
  const BlockLayout& layout = structure.layout;
  for (const MortarRegion& region : description.mortar) check_names(region, layout);
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
