#include <catch2/catch.hpp>
#include <cmath>

#include "core/error.h"
#include "core/structure/mirror_symmetry.h"
#include "core/structure/mortar_limits.h"
#include "core/structure/uncertain_parameters.h"
#include "generator/scenes/variants.h"
#include "tests/support/bridges.h"

namespace voussoir {
namespace {

void scale(std::vector<double>& values, double factor) {
  for (double& value : values) value *= factor;
}

/// The joint whose two blocks are the images of this one's.
std::size_t image_of(std::size_t joint, const Model& bridge) {
  const auto blocks_of = [](const Joint& at) { return std::minmax(at.first, at.second); };
  const auto image = [&](BlockId block) {
    return bridge.symmetry->block_image[static_cast<std::size_t>(value(block))];
  };
  const BlockId first = image(bridge.joints[joint].first), second = image(bridge.joints[joint].second);
  for (std::size_t i = 0; i < bridge.joints.size(); ++i)
    if (blocks_of(bridge.joints[i]) == std::minmax(first, second)) return i;
  return bridge.joints.size();
}

/// A joint between two blocks that meet in this one only and are not their own image.
std::size_t lone_joint(const Model& bridge) {
  for (std::size_t i = 0; i < bridge.joints.size(); ++i) {
    const auto same = [&](const Joint& joint) {
      return std::minmax(joint.first, joint.second) ==
             std::minmax(bridge.joints[i].first, bridge.joints[i].second);
    };
    if (std::ranges::count_if(bridge.joints, same) == 1 && image_of(i, bridge) != i) return i;
  }
  return bridge.joints.size();
}

}  // namespace

TEST_CASE("A variant with the parameters of its bridge is that bridge, to the last bit") {
  const Model bridge = test::small_bridge();
  const Model same = variant_of(bridge, variant_parameters(bridge.parameters));
  CHECK(same.parameters.joints[0].friction_angle == bridge.parameters.joints[0].friction_angle);
  CHECK(same.parameters.contact.normal_stiffness == bridge.parameters.contact.normal_stiffness);
  CHECK(variant_parameters(same.parameters) == variant_parameters(bridge.parameters));
  CHECK(same.symmetry.has_value());
}

TEST_CASE("A variant has the parameters that it is given") {
  const Model bridge = test::small_bridge();
  VariantParameters parameters = variant_parameters(bridge.parameters);
  scale(parameters.young_modulus, 1.1);
  scale(parameters.poisson_ratio, 0.9);
  scale(parameters.density, 1.05);
  scale(parameters.normal_stiffness, 1.2);
  scale(parameters.tangential_stiffness, 0.7);
  const Model variant = variant_of(bridge, parameters);
  CHECK(variant_parameters(variant.parameters) == parameters);
  CHECK(variant.parameters.joints[3].normal_stiffness == 1.2 * bridge.parameters.joints[3].normal_stiffness);
  CHECK(variant.parameters.contact.normal_stiffness == 1.2 * bridge.parameters.contact.normal_stiffness);
  CHECK(variant.parameters.blocks[5].density == 1.05 * bridge.parameters.blocks[5].density);
  CHECK(variant.mesh.nodes == bridge.mesh.nodes);
}

TEST_CASE("A drawn bridge comes back from its file's parameters, soil and new contacts with it") {
  BridgeDescription description = test::small_description();
  description.fill = {.unit_weight = 18e3, .surface = {Point(0.0, 3.0), Point(6.0, 3.0)}};
  const Model bridge = make_model(description);
  const Parameters drawn =
      sampled_parameters(bridge, uncertain_parameters(bridge, description.uncertainty), 7);
  const Parameters back = variant_of(bridge, variant_parameters(drawn)).parameters;
  REQUIRE(bridge.parameters.laid_mass.sum() > 0.0);
  CHECK(drawn.laid_mass.sum() != Approx(bridge.parameters.laid_mass.sum()));
  CHECK(back.laid_mass.isApprox(drawn.laid_mass, 1e-14));
  CHECK(drawn.contact.normal_stiffness != Approx(bridge.parameters.contact.normal_stiffness));
  CHECK(back.contact == drawn.contact);
}

TEST_CASE("A variant's mortar goes along with its joints (the limits of bridge files)", "[mortar]") {
  BridgeDescription description = test::small_description_with_mortar();
  description.joints.mortar.opening_energy = 1.3;  // f_t^2 / (2 p_n) is 1.25
  description.joints.mortar.slip_energy = 101.0;   // c^2 / p_t is 100
  const Model bridge = make_model(description);
  VariantParameters parameters = variant_parameters(bridge.parameters);
  CHECK(variant_of(bridge, parameters).parameters.joints == bridge.parameters.joints);
  scale(parameters.normal_stiffness, 0.3);
  scale(parameters.tangential_stiffness, 0.2);
  scale(parameters.friction_coefficient, 1.5);
  for (const JointMaterial& joint : variant_of(bridge, parameters).parameters.joints) {
    CHECK_FALSE(refused_energy(joint).has_value());
    CHECK_FALSE(refused_cohesion(joint.mortar).has_value());
    CHECK(joint.mortar.friction_coefficient() >= Approx(joint.friction_coefficient()));
  }
}

TEST_CASE("The friction of a thousand angles comes back to the last bit") {
  Model bridge = test::small_bridge();
  for (int i = 1; i < 1000; ++i) {
    Model other = bridge;
    for (JointMaterial& joint : other.parameters.joints) joint.friction_angle = 1.5e-3 * i;
    const VariantParameters parameters = variant_parameters(other.parameters);
    REQUIRE(variant_parameters(variant_of(bridge, parameters).parameters) == parameters);
  }
}

TEST_CASE("Parameters of another bridge are refused; every joint can have its own") {
  const Model bridge = test::small_bridge();
  VariantParameters parameters = variant_parameters(bridge.parameters);
  parameters.density.pop_back();
  CHECK_THROWS_WITH(variant_of(bridge, parameters), Catch::Contains("values of density"));
  parameters = variant_parameters(bridge.parameters);
  parameters.normal_stiffness.back() *= 2.0;
  const Model variant = variant_of(bridge, parameters);
  CHECK(variant_parameters(variant.parameters) == parameters);
  CHECK_FALSE(variant.symmetry.has_value());
}

TEST_CASE("Parameters are symmetric if and only if those of images are the same") {
  const Model bridge = test::small_bridge();
  REQUIRE(bridge.symmetry.has_value());
  const VariantParameters plain = variant_parameters(bridge.parameters);
  const auto symmetric = [&](const VariantParameters& parameters) {
    return are_symmetric(parameters, bridge.joints, *bridge.symmetry);
  };
  CHECK(symmetric(plain));
  const std::size_t joint = lone_joint(bridge);
  REQUIRE(joint < bridge.joints.size());
  VariantParameters changed = plain;
  changed.tangential_stiffness[joint] *= 2.0;
  CHECK_FALSE(symmetric(changed));
  changed.tangential_stiffness[image_of(joint, bridge)] *= 2.0;
  CHECK(symmetric(changed));
  changed.density[1] *= 1.1;
  REQUIRE(bridge.symmetry->block_image[1] != BlockId{1});
  CHECK_FALSE(symmetric(changed));
  changed.density[static_cast<std::size_t>(value(bridge.symmetry->block_image[1]))] *= 1.1;
  CHECK(symmetric(changed));
}

TEST_CASE("Drawn variants depend on their seed and number only, not on how many there are") {
  const Model bridge = test::small_bridge();
  const auto three = sampled_variants(bridge, {}, 3, 7);
  const auto two = sampled_variants(bridge, {}, 2, 7);
  REQUIRE(three.size() == 3);
  CHECK(three[0] == two[0]);
  CHECK(three[1] == two[1]);
  CHECK_FALSE(three[0] == three[1]);
  CHECK_FALSE(sampled_variants(bridge, {}, 1, 8)[0] == three[0]);
  CHECK_FALSE(variant_of(bridge, three[0]).symmetry.has_value());
}

TEST_CASE("Drawn joints scatter as they are said to: mean 1, coefficient of variation, p_t with p_n") {
  const Model bridge = test::small_bridge();
  Uncertainty only_joints{0.2, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  const VariantParameters nominal = variant_parameters(bridge.parameters);
  double sum = 0.0, squares = 0.0, count = 0.0;
  for (const VariantParameters& variant : sampled_variants(bridge, only_joints, 100, 1)) {
    CHECK(variant.density == nominal.density);
    CHECK(variant.friction_coefficient == nominal.friction_coefficient);
    for (std::size_t j = 0; j < bridge.joints.size(); ++j) {
      const double factor = variant.normal_stiffness[j] / nominal.normal_stiffness[j];
      REQUIRE(variant.tangential_stiffness[j] == Approx(factor * nominal.tangential_stiffness[j]));
      sum += factor, squares += factor * factor, ++count;
    }
  }
  const double mean = sum / count;
  // The factors are some 7,000 independent ones: five standard errors.
  CHECK(mean == Approx(1.0).margin(5.0 * 0.2 / std::sqrt(0.9 * count)));
  CHECK(std::sqrt(squares / count - mean * mean) == Approx(0.2).epsilon(0.06));
}

}  // namespace voussoir
