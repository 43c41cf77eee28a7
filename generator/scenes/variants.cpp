#include "generator/scenes/variants.h"

#include "core/error.h"
#include "core/random.h"
#include "core/structure/mortar_limits.h"
#include "core/structure/uncertain_parameters.h"
#include "database/records/order_of_sums.h"

namespace voussoir {
namespace {

void check_count(const std::vector<double>& values, std::size_t count, const char* what) {
  if (values.size() != count)
    throw InputError(fmt::format("a variant has {} values of {}, the bridge {}", values.size(), what, count));
}

/// The angle whose tangent is just this number: one of the neighbours of what atan gives.
double friction_angle(double coefficient) {
  const double angle = std::atan(coefficient);
  for (const double near : {std::nextafter(angle, 0.0), std::nextafter(angle, 2.0)})
    if (std::tan(angle) != coefficient && std::tan(near) == coefficient) return near;
  return angle;
}

/// By how much blocks are heavier than the bridge's [-]: so is the soil that lies on them, as the densities
/// of all blocks alike are uncertain.
double heavier_by(const std::vector<double>& density, const std::vector<Material>& blocks) {
  double sum = 0.0, nominal = 0.0;
  for (std::size_t b = 0; b < density.size(); ++b) {
    sum += density[b];
    nominal += blocks[b].density;
  }
  return nominal > 0.0 ? sum / nominal : 1.0;
}

bool same_in_images(const std::vector<double>& values, const std::vector<std::size_t>& images) {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (images[i] >= values.size() || values[i] != values[images[i]]) return false;
  return true;
}

}  // namespace

Model variant_of(const Model& bridge, const VariantParameters& parameters) {
  const std::size_t blocks = bridge.layout.size();
  const std::size_t joints = bridge.joints.size();
  check_count(parameters.young_modulus, blocks, "Young's modulus");
  check_count(parameters.poisson_ratio, blocks, "Poisson's ratio");
  check_count(parameters.density, blocks, "density");
  check_count(parameters.normal_stiffness, joints, "normal stiffness");
  check_count(parameters.tangential_stiffness, joints, "tangential stiffness");
  check_count(parameters.friction_coefficient, joints, "friction");
  Model variant = bridge;
  for (std::size_t b = 0; b < blocks; ++b) {
    Material& block = variant.parameters.blocks[b];
    block.young_modulus = parameters.young_modulus[b];
    block.poisson_ratio = parameters.poisson_ratio[b];
    block.density = parameters.density[b];
  }
  for (std::size_t j = 0; j < joints; ++j) {
    JointMaterial& joint = variant.parameters.joints[j];
    joint.normal_stiffness = parameters.normal_stiffness[j];
    joint.tangential_stiffness = parameters.tangential_stiffness[j];
    if (parameters.friction_coefficient[j] != joint.friction_coefficient())
      joint.friction_angle = friction_angle(parameters.friction_coefficient[j]);
    joint.mortar = mortar_on(joint, bridge.parameters.joints[j]);
  }
  variant.parameters.laid_mass *= heavier_by(parameters.density, bridge.parameters.blocks);
  variant.parameters.contact = drawn_contact(variant.parameters.joints, bridge.parameters);
  if (variant.symmetry && !are_symmetric(parameters, bridge.joints, *variant.symmetry))
    variant.symmetry.reset();
  return variant;
}

std::vector<VariantParameters> sampled_variants(const Model& bridge, const Uncertainty& uncertainty,
                                                int count, std::uint64_t seed) {
  fix_order_of_sums();
  const UncertainParameters uncertain = uncertain_parameters(bridge, uncertainty);
  std::vector<VariantParameters> variants;
  for (int number = 0; number < count; ++number)
    variants.push_back(variant_parameters(
        sampled_parameters(bridge, uncertain, series_seed(seed, static_cast<std::uint64_t>(number)))));
  return variants;
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
