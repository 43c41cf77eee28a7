#include "core/structure/regions.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace voussoir {
namespace {

bool names(const Region& region, const Block& block) {
  return std::ranges::any_of(region.of, [&](const std::string& name) { return is_called(block, name); });
}

JointMaterial weaker(const JointMaterial& a, const JointMaterial& b) {
  return {.normal_stiffness = std::min(a.normal_stiffness, b.normal_stiffness),
          .tangential_stiffness = std::min(a.tangential_stiffness, b.tangential_stiffness),
          .friction_angle = std::min(a.friction_angle, b.friction_angle)};
}

}  // namespace

void set_regions(const BridgeDescription& description, const Structure& structure, Parameters& parameters) {
  std::vector<JointMaterial> of_block(structure.layout.size(), description.joints);
  for (const Region& region : description.regions) {
    structure.layout.expect("of in [[regions]]", region.of, description.missing_blocks);
    for (std::size_t b = 0; b < structure.layout.size(); ++b) {
      if (!names(region, structure.layout.blocks[b])) continue;
      parameters.blocks[b] = region.material;
      of_block[b] = region.joints;
    }
  }
  const auto of = [&](BlockId block) { return of_block[static_cast<std::size_t>(value(block))]; };
  for (std::size_t j = 0; j < structure.joints.size(); ++j)
    parameters.joints[j] = weaker(of(structure.joints[j].first), of(structure.joints[j].second));
}

bool has_symmetric_parameters(const Model& bridge) {
  const Parameters& parameters = bridge.parameters;
  const MirrorSymmetry& symmetry = *bridge.symmetry;
  for (std::size_t b = 0; b < bridge.layout.size(); ++b)
    if (parameters.blocks[b] != parameters.blocks[static_cast<std::size_t>(value(symmetry.block_image[b]))])
      return false;
  std::map<std::pair<BlockId, BlockId>, JointMaterial> between;  // joints of a pair are alike
  for (std::size_t j = 0; j < bridge.joints.size(); ++j)
    between[std::minmax(bridge.joints[j].first, bridge.joints[j].second)] = parameters.joints[j];
  const auto image = [&](BlockId block) {
    return symmetry.block_image[static_cast<std::size_t>(value(block))];
  };
  for (const auto& [blocks, law] : between) {
    const BlockId a = image(blocks.first), b = image(blocks.second);
    const auto found = between.find(std::minmax(a, b));
    if (found == between.end() || found->second != law) return false;
  }
  const double largest = parameters.laid_mass.size() > 0 ? parameters.laid_mass.maxCoeff() : 0.0;
  for (Eigen::Index node = 0; node < parameters.laid_mass.size(); ++node) {
    const auto other = value(symmetry.node_image[static_cast<std::size_t>(node)]);
    if (std::abs(parameters.laid_mass[node] - parameters.laid_mass[other]) > 1e-9 * largest) return false;
  }
  return true;
}

}  // namespace voussoir
