#include "core/structure/parameters.h"

#include <algorithm>

namespace voussoir {

Parameters uniform_parameters(const Structure& structure, const Material& material,
                              const JointMaterial& joints, double gravity) {
  return {.gravity = gravity,
          .blocks = std::vector<Material>(structure.layout.size(), material),
          .joints = std::vector<JointMaterial>(structure.joints.size(), joints),
          .contact = joints};
}

JointMaterial softened(JointMaterial joint, double share) {
  joint.normal_stiffness *= share;
  joint.tangential_stiffness *= share;
  return joint;
}

double joint_thickness(const Joint& joint, const Parameters& parameters) {
  const auto of = [&](BlockId block) {
    return parameters.blocks[static_cast<std::size_t>(value(block))].thickness;
  };
  return std::min(of(joint.first), of(joint.second));
}

}  // namespace voussoir
