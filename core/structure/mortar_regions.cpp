#include "core/structure/mortar_regions.h"

#include <algorithm>

#include "core/error.h"
#include "core/structure/halved_blocks.h"
#include "core/structure/mortar_limits.h"

namespace voussoir {
namespace {

bool lies_in(const MortarRegion& region, const Block& first, const Block& second) {
  const auto& names = region.between;
  if (names.empty()) return true;
  return (is_called(first, names[0]) && is_called(second, names[1])) ||
         (is_called(first, names[1]) && is_called(second, names[0]));
}

/// The last of the regions in which the joint lies, or nothing.
const MortarRegion* region_of(const Joint& joint, const BridgeDescription& description,
                              const BlockLayout& layout) {
  const Block& first = layout[joint.first];
  const Block& second = layout[joint.second];
  const bool within = are_halves(first, second, description.wall);
  for (auto region = description.mortar.rbegin(); region != description.mortar.rend(); ++region)
    if (region->within_blocks == within && lies_in(*region, first, second)) return &*region;
  return nullptr;
}

void check_energy(const JointMaterial& material, const Joint& joint, const BlockLayout& layout) {
  if (!material.mortar.is_there()) return;
  if (const auto refused = refused_energy(material))
    throw InputError(fmt::format("{} in [[mortar]], of the joint between '{}' and '{}': {}", refused->key,
                                 layout[joint.first].label, layout[joint.second].label, refused->reason));
}

}  // namespace

void lay_mortar(const BridgeDescription& description, const Structure& structure, Parameters& parameters) {
  const BlockLayout& layout = structure.layout;
  for (const MortarRegion& region : description.mortar)
    layout.expect("between in [[mortar]]", region.between, description.missing_blocks);
  const bool held_together = std::ranges::any_of(description.mortar, &MortarRegion::within_blocks);
  if (description.wall.halved && !held_together)
    throw InputError("halved in [wall]: expected a table [[mortar]] with within_blocks = true beside it");
  for (std::size_t j = 0; j < structure.joints.size(); ++j) {
    const MortarRegion* region = region_of(structure.joints[j], description, layout);
    if (region == nullptr) continue;
    JointMaterial& joint = parameters.joints[j];
    joint.mortar = region->mortar;
    joint.normal_stiffness = region->normal_stiffness.value_or(joint.normal_stiffness);
    joint.tangential_stiffness = region->tangential_stiffness.value_or(joint.tangential_stiffness);
    check_energy(joint, structure.joints[j], layout);
  }
}

}  // namespace voussoir
