#include "core/motion/bonds.h"

#include <algorithm>

#include "core/statics/elements.h"

namespace voussoir {
namespace {

bool is_gone(const CohesiveStiffness& law, const JointMemory& memory) {
  return !memory.bond.empty() && std::ranges::all_of(memory.bond, [&](const BondMemory& point) {
    return bond_left(law, point) < kBondGone && point.crushed == 0.0;
  });
}

}  // namespace

std::vector<BondedJoint> bonded_joints(const Model& model, const ContactSearch& search) {
  std::vector<BondedJoint> joints;
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const JointMaterial& material = model.parameters.joints[j];
    if (!material.mortar.is_there()) continue;
    const Joint& joint = model.joints[j];
    const auto [a, b, c, d] = corners(joint);
    joints.push_back(
        {.pair = search.pair_of(joint),
         .blocks = {static_cast<std::size_t>(value(joint.first)),
                    static_cast<std::size_t>(value(joint.second))},
         .nodes = {value(a), value(b), value(c), value(d)},
         .frame = make_joint_frame(joint, model.mesh),
         .law = cohesive_stiffness(material, joint.length * joint_thickness(joint, model.parameters))});
  }
  std::ranges::sort(joints, {}, &BondedJoint::pair);
  return joints;
}

Vector8d follow_bond(const BondedJoint& joint, const Vector8d& displacement, MortarBond& bond) {
  const JointPose pose = joint_pose(joint.frame, displacement);
  BondStep step = bond_step(joint.law, bond.memory, pose.state);
  bond.memory = std::move(step.memory);
  bond.holds = !is_gone(joint.law, bond.memory);
  return -corner_forces(joint.frame, pose, step.force);
}

}  // namespace voussoir
