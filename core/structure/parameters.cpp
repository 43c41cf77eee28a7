#include "core/structure/parameters.h"

#include <algorithm>
#include <cmath>

#include "core/median.h"

namespace voussoir {
namespace {

/// Of values that are there; 1 without any.
double median_ratio(const std::vector<JointMaterial>& drawn, const std::vector<JointMaterial>& nominal,
                    double (*value)(const JointMaterial&)) {
  std::vector<double> ratios;
  for (std::size_t j = 0; j < drawn.size(); ++j)
    if (value(nominal[j]) > 0.0) ratios.push_back(value(drawn[j]) / value(nominal[j]));
  return ratios.empty() ? 1.0 : median(ratios);
}

}  // namespace

Parameters uniform_parameters(const Structure& structure, const Material& material,
                              const JointMaterial& joints, double gravity) {
  return {.gravity = gravity,
          .blocks = std::vector<Material>(structure.layout.size(), material),
          .joints = std::vector<JointMaterial>(structure.joints.size(), joints),
          .laid_mass = {},
          .contact = {.normal_stiffness = joints.normal_stiffness,
                      .tangential_stiffness = joints.tangential_stiffness,
                      .friction_angle = joints.friction_angle},
          .contact_share = {}};
}

JointMaterial softened(JointMaterial joint, double share) {
  joint.normal_stiffness *= share;
  joint.tangential_stiffness *= share;
  return joint;
}

JointMaterial drawn_contact(const std::vector<JointMaterial>& drawn, const Parameters& nominal) {
  const auto ratio = [&](double (*value)(const JointMaterial&)) {
    return median_ratio(drawn, nominal.joints, value);
  };
  JointMaterial contact = nominal.contact;
  contact.normal_stiffness *= ratio([](const JointMaterial& joint) { return joint.normal_stiffness; });
  contact.tangential_stiffness *=
      ratio([](const JointMaterial& joint) { return joint.tangential_stiffness; });
  const double of_friction = ratio([](const JointMaterial& joint) { return joint.friction_coefficient(); });
  if (of_friction != 1.0) contact.friction_angle = std::atan(contact.friction_coefficient() * of_friction);
  return contact;
}

bool has_mortar(const Parameters& parameters) {
  return std::ranges::any_of(parameters.joints,
                             [](const JointMaterial& joint) { return joint.mortar.is_there(); });
}

double joint_thickness(const Joint& joint, const Parameters& parameters) {
  const auto of = [&](BlockId block) {
    return parameters.blocks[static_cast<std::size_t>(value(block))].thickness;
  };
  return std::min(of(joint.first), of(joint.second));
}

}  // namespace voussoir
