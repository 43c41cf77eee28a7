#include "generator/variants.h"

#include <algorithm>
#include <map>

#include "core/error.h"

namespace voussoir {
namespace {

double only_value(const std::vector<double>& values, std::size_t count, double if_none, const char* what) {
  if (values.size() != count)
    throw InputError(fmt::format("a variant has {} values of {}, the bridge {}", values.size(), what, count));
  if (std::adjacent_find(values.begin(), values.end(), std::not_equal_to<>()) != values.end())
    throw InputError(fmt::format("a variant has different values of {}: one is expected", what));
  return values.empty() ? if_none : values.front();
}

/// The angle whose tangent is just this number: one of the neighbours of what atan gives.
double friction_angle(double coefficient) {
  const double angle = std::atan(coefficient);
  for (const double near : {std::nextafter(angle, 0.0), std::nextafter(angle, 2.0)})
    if (std::tan(angle) != coefficient && std::tan(near) == coefficient) return near;
  return angle;
}

using JointNodes = std::array<int, 4>;  // in ascending order

JointNodes nodes_of(const Joint& joint, const std::vector<NodeId>* image) {
  JointNodes nodes = {value(joint.first_edge.from), value(joint.first_edge.to), value(joint.second_edge.from),
                      value(joint.second_edge.to)};
  if (image)
    for (int& node : nodes) node = value((*image)[static_cast<std::size_t>(node)]);
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

/// The image of each joint; the number of joints where there is none.
std::vector<std::size_t> joint_images(const std::vector<Joint>& joints, const MirrorSymmetry& symmetry) {
  std::map<JointNodes, std::size_t> places;
  for (std::size_t i = 0; i < joints.size(); ++i) places[nodes_of(joints[i], nullptr)] = i;
  std::vector<std::size_t> images;
  for (const Joint& joint : joints) {
    const auto image = places.find(nodes_of(joint, &symmetry.node_image));
    images.push_back(image == places.end() ? joints.size() : image->second);
  }
  return images;
}

bool same_in_images(const std::vector<double>& values, const std::vector<std::size_t>& images) {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (images[i] >= values.size() || values[i] != values[images[i]]) return false;
  return true;
}

}  // namespace

VariantParameters parameters_of(const Bridge& bridge) {
  const Material& material = bridge.description.material;
  const JointMaterial& joint = bridge.description.joints;
  const std::size_t blocks = bridge.layout.size();
  const std::size_t joints = bridge.joints.size();
  const auto all = [](std::size_t count, double value) { return std::vector<double>(count, value); };
  return {all(blocks, material.young_modulus),     all(blocks, material.poisson_ratio),
          all(blocks, material.density),           all(joints, joint.normal_stiffness),
          all(joints, joint.tangential_stiffness), all(joints, joint.friction_coefficient())};
}

Bridge variant_of(const Bridge& bridge, const VariantParameters& parameters) {
  Bridge variant = bridge;
  Material& material = variant.description.material;
  JointMaterial& joint = variant.description.joints;
  const std::size_t blocks = bridge.layout.size();
  const std::size_t joints = bridge.joints.size();
  const auto take = [](double& value, const std::vector<double>& values, std::size_t count,
                       const char* what) { value = only_value(values, count, value, what); };
  take(material.young_modulus, parameters.young_modulus, blocks, "Young's modulus");
  take(material.poisson_ratio, parameters.poisson_ratio, blocks, "Poisson's ratio");
  take(material.density, parameters.density, blocks, "density");
  take(joint.normal_stiffness, parameters.normal_stiffness, joints, "normal stiffness");
  take(joint.tangential_stiffness, parameters.tangential_stiffness, joints, "tangential stiffness");
  double friction = joint.friction_coefficient();
  take(friction, parameters.friction_coefficient, joints, "friction");
  if (friction != joint.friction_coefficient()) joint.friction_angle = friction_angle(friction);
  if (variant.symmetry && !are_symmetric(parameters, bridge.joints, *variant.symmetry))
    variant.symmetry.reset();
  return variant;
}

bool are_symmetric(const VariantParameters& parameters, const std::vector<Joint>& joints,
                   const MirrorSymmetry& symmetry) {
  std::vector<std::size_t> blocks;
  for (const BlockId image : symmetry.block_image) blocks.push_back(static_cast<std::size_t>(value(image)));
  const std::vector<std::size_t> images = joint_images(joints, symmetry);
  return same_in_images(parameters.young_modulus, blocks) &&
         same_in_images(parameters.poisson_ratio, blocks) && same_in_images(parameters.density, blocks) &&
         same_in_images(parameters.normal_stiffness, images) &&
         same_in_images(parameters.tangential_stiffness, images) &&
         same_in_images(parameters.friction_coefficient, images);
}

}  // namespace voussoir
