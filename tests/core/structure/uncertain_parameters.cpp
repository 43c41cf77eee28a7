/// @file Oracles: the definition of a lognormal factor written out, moments of many draws within four
/// standard errors, rigid movements by hand.

#include "core/structure/uncertain_parameters.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>

#include "core/structure/mortar_limits.h"
#include "tests/support/bridges.h"
#include "tests/support/covariance_of_draws.h"

using namespace voussoir;

namespace {

double deviation(double variation) {
  return std::sqrt(std::log(1.0 + variation * variation));
}

Eigen::VectorXd unit(std::size_t size, std::size_t place, double value) {
  Eigen::VectorXd theta = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(size));
  theta[static_cast<Eigen::Index>(place)] = value;
  return theta;
}

std::size_t place_of(const std::vector<UncertainAction>& actions, const std::string& name) {
  for (std::size_t i = 0; i < actions.size(); ++i)
    if (actions[i].parameter.name == name) return i;
  throw std::runtime_error("no parameter " + name);
}

/// Without what joints have of their own, whose mean shifts the factors at theta = 0.
Uncertainty without_own() {
  Uncertainty uncertainty;
  uncertainty.joint_stiffness = 0.0;
  uncertainty.regional_stiffness = 0.0;
  return uncertainty;
}

}  // namespace

TEST_CASE("The reference bridge has five common factors, one of each pair of blocks, and two feet and sides",
          "[uncertainty]") {
  const Model bridge = test::reference_bridge();
  const UncertainParameters uncertain = uncertain_parameters(bridge, {});
  std::set<std::pair<BlockId, BlockId>> pairs;
  for (const Joint& joint : bridge.joints) pairs.insert(std::minmax(joint.first, joint.second));
  CHECK(uncertain.of_bridge.size() == 5 + pairs.size());
  std::vector<std::string> names;
  for (const UncertainAction& action : uncertain.of_epoch) names.push_back(action.parameter.name);
  CHECK(names == std::vector<std::string>{"temperature", "foot 1 dx", "foot 1 dy", "foot 1 rotation",
                                          "foot 2 dx", "foot 2 dy", "foot 2 rotation", "left side dx",
                                          "right side dx", "joint stiffness"});
  std::set<std::string> all;
  std::vector<int> uses(bridge.joints.size(), 0);
  for (const UncertainParameter& parameter : uncertain.all()) {
    CHECK(parameter.sigma > 0.0);
    all.insert(parameter.name);
  }
  CHECK(all.size() == uncertain.of_bridge.size() + uncertain.of_epoch.size());
  for (std::size_t i = 5; i < uncertain.of_bridge.size(); ++i)
    for (const std::size_t joint : uncertain.of_bridge[i].joints) ++uses[joint];
  CHECK(uses == std::vector<int>(bridge.joints.size(), 1));
}

TEST_CASE("At theta = 0 without own scatter the bridge is as stated, to the last bit", "[uncertainty]") {
  const Model bridge = test::small_bridge();
  const UncertainParameters uncertain = uncertain_parameters(bridge, without_own());
  const Parameters same = parameters_at(bridge, uncertain, unit(uncertain.of_bridge.size(), 0, 0.0));
  for (std::size_t j = 0; j < bridge.joints.size(); ++j) {
    CHECK(same.joints[j].normal_stiffness == bridge.parameters.joints[j].normal_stiffness);
    CHECK(same.joints[j].tangential_stiffness == bridge.parameters.joints[j].tangential_stiffness);
    CHECK(same.joints[j].friction_coefficient() ==
          Approx(bridge.parameters.joints[j].friction_coefficient()).epsilon(1e-15).margin(0.0));
  }
  CHECK(same.blocks[3].young_modulus == bridge.parameters.blocks[3].young_modulus);
  CHECK(same.blocks[3].density == bridge.parameters.blocks[3].density);
}

TEST_CASE("Each common parameter multiplies its own quantity by its lognormal factor (by hand)",
          "[uncertainty]") {
  const Model bridge = test::small_bridge();
  const Uncertainty uncertainty = without_own();
  const UncertainParameters uncertain = uncertain_parameters(bridge, uncertainty);
  const auto factors = [&](const std::string& name, double theta) {
    const Parameters p = parameters_at(
        bridge, uncertain, unit(uncertain.of_bridge.size(), place_of(uncertain.of_bridge, name), theta));
    const JointMaterial& joint = bridge.parameters.joints[5];
    const Material& block = bridge.parameters.blocks[5];
    return std::vector<double>{p.joints[5].normal_stiffness / joint.normal_stiffness,
                               p.joints[5].tangential_stiffness / joint.tangential_stiffness,
                               p.joints[5].friction_coefficient() / joint.friction_coefficient(),
                               p.blocks[5].young_modulus / block.young_modulus,
                               p.blocks[5].density / block.density};
  };
  const auto check = [&](const std::string& name, double variation, const std::vector<int>& acts) {
    INFO(name);
    const std::vector<double> found = factors(name, 1.5);
    for (std::size_t i = 0; i < found.size(); ++i)
      CHECK(found[i] == Approx(acts[i] != 0 ? std::exp(1.5 * deviation(variation)) : 1.0).epsilon(1e-12));
  };
  check("stiffness", uncertainty.common_stiffness, {1, 1, 0, 0, 0});
  check("stiffness ratio", uncertainty.stiffness_ratio, {0, 1, 0, 0, 0});
  check("friction", uncertainty.friction, {0, 0, 1, 0, 0});
  check("young modulus", uncertainty.young_modulus, {0, 0, 0, 1, 0});
  check("density", uncertainty.density, {0, 0, 0, 0, 1});
}

TEST_CASE("Joints scatter with mean 1 and the stated variation, pair by pair (moments of 400 bridges)",
          "[uncertainty]") {
  const Model bridge = test::small_bridge();
  Uncertainty uncertainty{.joint_stiffness = 0.2,
                          .regional_stiffness = 0.0,
                          .common_stiffness = 0.0,
                          .stiffness_ratio = 0.0,
                          .friction = 0.0,
                          .young_modulus = 0.0,
                          .density = 0.0};
  const std::size_t pairs = uncertain_parameters(bridge, uncertainty).of_bridge.size();
  double sum = 0.0, squares = 0.0;
  double count = 0.0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const Model one = sampled(bridge, uncertainty, seed);
    std::map<std::pair<BlockId, BlockId>, double> of_pair;
    for (std::size_t j = 0; j < bridge.joints.size(); ++j) {
      const double factor = one.parameters.joints[j].normal_stiffness / 1e9;
      REQUIRE(one.parameters.joints[j].tangential_stiffness / 1e8 == Approx(factor).epsilon(1e-12));
      const auto blocks = std::minmax(bridge.joints[j].first, bridge.joints[j].second);
      const auto [known, is_new] = of_pair.emplace(blocks, factor);
      REQUIRE(known->second == factor);
      if (!is_new) continue;
      sum += factor;
      squares += factor * factor;
      count += 1.0;
    }
    REQUIRE(of_pair.size() == pairs);
  }
  const double mean = sum / count;
  CHECK(std::abs(mean - 1.0) < 4.0 * 0.2 / std::sqrt(count));
  CHECK(std::sqrt(squares / count - mean * mean) == Approx(0.2).epsilon(4.0 * 1.2 / std::sqrt(2.0 * count)));
}

TEST_CASE("Joints that are near each other scatter alike beside what is their own (moments of 400 bridges)",
          "[uncertainty]") {
  const Model bridge = test::small_bridge();
  const UncertainParameters uncertain = uncertain_parameters(bridge, {.joint_stiffness = 0.3,
                                                                      .regional_stiffness = 0.3,
                                                                      .common_stiffness = 0.0,
                                                                      .stiffness_ratio = 0.0,
                                                                      .friction = 0.0,
                                                                      .young_modulus = 0.0,
                                                                      .density = 0.0});
  const double alone = deviation(0.3), shared = deviation(0.3), length = bridge.mesh.nodes.row(0).maxCoeff();
  constexpr int draws = 400;
  Eigen::MatrixXd logs(static_cast<Eigen::Index>(uncertain.of_bridge.size()), draws);
  for (int draw = 0; draw < draws; ++draw) {
    const Parameters drawn = sampled_parameters(bridge, uncertain, static_cast<std::uint64_t>(draw));
    for (std::size_t i = 0; i < uncertain.of_bridge.size(); ++i)
      logs(static_cast<Eigen::Index>(i), draw) =
          std::log(drawn.joints[uncertain.of_bridge[i].joints.front()].normal_stiffness / 1e9) +
          0.5 * (alone * alone + shared * shared);
  }
  const std::vector<Point> places = places_of(uncertain.of_bridge, bridge);
  const auto stated =
      Eigen::MatrixXd::NullaryExpr(logs.rows(), logs.rows(), [&](Eigen::Index i, Eigen::Index j) {
        const Point way = places[static_cast<std::size_t>(i)] - places[static_cast<std::size_t>(j)];
        return shared * shared * std::exp(-way.norm() / (0.25 * length)) + (i == j ? alone * alone : 0.0);
      });
  CHECK(test::worst_covariance_error(logs, stated) < 4.5);  // of some thousand that depend on each other
}

TEST_CASE("The same seed draws the same bridge, another seed another one", "[uncertainty]") {
  const Model bridge = test::small_bridge();
  const auto stiffness = [&](std::uint64_t seed) {
    std::vector<double> values;
    for (const JointMaterial& joint : sampled(bridge, {}, seed).parameters.joints)
      values.push_back(joint.normal_stiffness);
    return values;
  };
  CHECK(stiffness(3) == stiffness(3));
  CHECK(stiffness(3) != stiffness(4));
  CHECK_FALSE(sampled(bridge, {}, 3).symmetry.has_value());
}

TEST_CASE("What is known exactly is no parameter", "[uncertainty]") {
  const Uncertainty nothing{0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  CHECK(uncertain_parameters(test::small_bridge(), nothing).all().empty());
}

TEST_CASE("In an epoch all joints are softer or stiffer by one factor (by hand)", "[uncertainty]") {
  const Model bridge = test::small_bridge();
  const UncertainParameters uncertain = uncertain_parameters(bridge, {});
  const std::size_t count = uncertain.of_epoch.size(),
                    place = place_of(uncertain.of_epoch, "joint stiffness");
  const Stage softer = in_epoch({}, bridge, uncertain, unit(count, place, -2.0));
  REQUIRE(softer.joint_stiffness.size() == static_cast<Eigen::Index>(bridge.joints.size()));
  CHECK(softer.joint_stiffness.isApproxToConstant(std::exp(-2.0 * deviation(0.05))));
  CHECK(softer.temperature == 0.0);
  CHECK(softer.support_movement.isZero(0.0));
  CHECK(in_epoch({}, bridge, uncertain, unit(count, 0, 1.0)).joint_stiffness.isOnes(0.0));
}

TEST_CASE("A foot moves and turns as a rigid body about its middle (by hand)", "[uncertainty]") {
  const Model bridge = test::reference_bridge();
  const UncertainParameters uncertain = uncertain_parameters(bridge, {});
  const auto movement = [&](const std::string& name) {
    const std::size_t place = place_of(uncertain.of_epoch, name);
    return in_epoch({}, bridge, uncertain, unit(uncertain.of_epoch.size(), place, 2.0)).support_movement;
  };
  const Field shift = movement("foot 1 dy");
  const Field turn = movement("foot 2 rotation");
  const Field side = movement("right side dx");
  int left = 0, right = 0, held = 0;
  for (int node = 0; node < bridge.mesh.node_count(); ++node) {
    const Point at = bridge.mesh.nodes.col(node);
    const bool on_ground = at.y() == 0.0;
    const double dy = on_ground && at.x() < 10.0 ? 2e-3 : 0.0;
    CHECK(shift(1, node) == Approx(dy).margin(1e-15));
    CHECK(shift(0, node) == 0.0);
    // The right foot stands on 13.5 <= x <= 20.
    const double turned = on_ground && at.x() > 10.0 ? 2e-4 * (at.x() - 16.75) : 0.0;
    CHECK(turn(1, node) == Approx(turned).margin(1e-15));
    CHECK(side(0, node) == (at.x() == 20.0 && !on_ground ? 1e-3 : 0.0));  // the corner goes with the foot
    left += dy != 0.0 ? 1 : 0;
    right += turned != 0.0 ? 1 : 0;
    held += side(0, node) != 0.0 ? 1 : 0;
  }
  CHECK(left > 5);
  CHECK(right > 5);
  CHECK(held > 5);
}

TEST_CASE("Mortar on softer joints stores the same share of what breaks it (the limits of bridge files)",
          "[uncertainty][mortar]") {
  BridgeDescription description = test::small_description_with_mortar();
  description.joints.mortar.opening_energy = 1.3;  // f_t^2 / (2 p_n) is 1.25
  description.joints.mortar.slip_energy = 101.0;   // c^2 / p_t is 100
  description.joints.mortar.compressive_strength = 1e6;
  description.joints.mortar.crushing_energy = 1001.0;  // f_m^2 / p_n is 1000
  const Model bridge = make_model(description);
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const Parameters drawn = sampled(bridge, {}, seed).parameters;
    for (std::size_t j = 0; j < bridge.joints.size(); ++j) {
      const JointMaterial& joint = drawn.joints[j];
      REQUIRE_FALSE(refused_energy(joint).has_value());
      CHECK(joint.mortar.opening_energy * joint.normal_stiffness == Approx(1.3 * 1e9));
      CHECK(joint.mortar.slip_energy * joint.tangential_stiffness / std::pow(joint.mortar.cohesion, 2) ==
            Approx(1.01));
      CHECK(joint.mortar.friction_coefficient() == Approx(joint.friction_coefficient()));
      CHECK_FALSE(refused_cohesion(joint.mortar).has_value());
      CHECK(joint.mortar.crushing_energy * joint.normal_stiffness == Approx(1001.0 * 1e9));
    }
  }
}

TEST_CASE(
    "Whether anything is uncertain is said as the list of parameters says (each key alone, free sides)") {
  const Uncertainty none{0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  const Model bridge = make_model(test::small_description());
  CHECK_FALSE(has_uncertain_parameters(bridge, none));
  for (double Uncertainty::*const key :
       {&Uncertainty::joint_stiffness, &Uncertainty::regional_stiffness, &Uncertainty::common_stiffness,
        &Uncertainty::stiffness_ratio, &Uncertainty::friction, &Uncertainty::young_modulus,
        &Uncertainty::density, &Uncertainty::temperature, &Uncertainty::foot_movement,
        &Uncertainty::foot_rotation, &Uncertainty::side_movement, &Uncertainty::epoch_stiffness,
        &Uncertainty::epoch_unevenness, &Uncertainty::uneven_temperature}) {
    Uncertainty one = none;
    one.*key = 0.1;
    CHECK(has_uncertain_parameters(bridge, one) == !uncertain_parameters(bridge, one).all().empty());
  }
  BridgeDescription free = test::small_description();
  free.supports.sides = SupportKind::free;
  Uncertainty sides = none;
  sides.side_movement = 1e-3;
  CHECK_FALSE(has_uncertain_parameters(make_model(free), sides));
}
