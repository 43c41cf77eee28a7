#include "core/structure/uncertain_parameters.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "core/random.h"
#include "core/structure/correlation_by_distance.h"
#include "core/structure/mortar_limits.h"
#include "core/structure/rigid_movement.h"

namespace voussoir {
namespace {

bool turns(const Support& support) {
  return support.holds_y && support.nodes.size() > 1;
}

std::vector<std::size_t> all_joints(const Structure& structure) {
  std::vector<std::size_t> joints(structure.joints.size());
  for (std::size_t j = 0; j < joints.size(); ++j) joints[j] = j;
  return joints;
}

/// Adds a factor unless it is known exactly.
void add_factor(std::vector<UncertainAction>& actions, UncertainQuantity quantity, const std::string& name,
                double variation, std::vector<std::size_t> joints = {}) {
  if (variation > 0.0)
    actions.push_back({quantity, {name, "1", log_deviation(variation), false}, std::move(joints)});
}

void add_of_epoch(std::vector<UncertainAction>& actions, UncertainQuantity quantity, const std::string& name,
                  const char* unit, double sigma, std::size_t support = 0) {
  if (sigma > 0.0) actions.push_back({quantity, {name, unit, sigma, true}, {}, support, false});
}

double factor_of(const UncertainAction& action, double theta) {
  const double s = action.parameter.sigma;
  return std::exp(s * theta - (action.has_mean_one ? 0.5 * s * s : 0.0));
}

void apply(const UncertainAction& action, double theta, Parameters& parameters) {
  const double factor = factor_of(action, theta);
  for (const std::size_t j : action.joints) {
    JointMaterial& joint = parameters.joints[j];
    JointMaterial drawn = joint;
    if (action.quantity == UncertainQuantity::stiffness) drawn.normal_stiffness *= factor;
    if (action.quantity == UncertainQuantity::friction)
      drawn.friction_angle = std::atan(joint.friction_coefficient() * factor);
    else
      drawn.tangential_stiffness *= factor;
    drawn.mortar = mortar_on(drawn, joint);
    joint = drawn;
  }
  if (action.quantity == UncertainQuantity::density) parameters.laid_mass *= factor;
  for (Material& block : parameters.blocks) {
    if (action.quantity == UncertainQuantity::young_modulus) block.young_modulus *= factor;
    if (action.quantity == UncertainQuantity::density) block.density *= factor;
  }
}

/// The variance of a factor's logarithm is that of the pair's own part and of what it shares with others.
void add_own_stiffness(const Structure& structure, const Uncertainty& uncertainty,
                       UncertainParameters& result) {
  const double alone = log_deviation(uncertainty.joint_stiffness);
  const double shared = log_deviation(uncertainty.regional_stiffness);
  std::vector<UncertainAction> own = own_stiffness(structure, std::hypot(alone, shared));
  const auto common = static_cast<Eigen::Index>(result.of_bridge.size());
  const auto pairs = static_cast<Eigen::Index>(own.size());
  result.correlation_factor = Eigen::MatrixXd::Identity(common + pairs, common + pairs);
  if (shared > 0.0 && pairs > 0) {
    const double share = shared * shared / (alone * alone + shared * shared);
    const Eigen::MatrixXd correlations =
        share * correlations_by_distance(structure, places_of(own, structure)) +
        (1.0 - share) * Eigen::MatrixXd::Identity(pairs, pairs);
    result.correlation_factor.bottomRightCorner(pairs, pairs) = correlations.llt().matrixL();
  }
  std::ranges::move(own, std::back_inserter(result.of_bridge));
}

}  // namespace

std::vector<UncertainParameter> UncertainParameters::all() const {
  std::vector<UncertainParameter> parameters;
  for (const auto* actions : {&of_bridge, &of_epoch})
    for (const UncertainAction& action : *actions) parameters.push_back(action.parameter);
  return parameters;
}

double log_deviation(double variation) {
  return std::sqrt(std::log1p(variation * variation));
}

/// Pairs come in the order of their first stretches.
std::vector<UncertainAction> own_stiffness(const Structure& structure, double deviation) {
  std::vector<UncertainAction> actions;
  if (deviation == 0.0) return actions;
  std::map<std::pair<BlockId, BlockId>, std::size_t> places;
  std::vector<std::vector<std::size_t>> stretches;
  for (std::size_t j = 0; j < structure.joints.size(); ++j) {
    const auto blocks = std::minmax(structure.joints[j].first, structure.joints[j].second);
    const auto [place, is_new] = places.try_emplace(blocks, stretches.size());
    if (is_new) stretches.emplace_back();
    stretches[place->second].push_back(j);
  }
  const auto label = [&](BlockId block) {
    return structure.layout.blocks[static_cast<std::size_t>(value(block))].label;
  };
  for (std::vector<std::size_t>& joints : stretches) {
    const Joint& joint = structure.joints[joints.front()];
    actions.push_back(
        {UncertainQuantity::stiffness,
         {fmt::format("stiffness {}/{}", label(joint.first), label(joint.second)), "1", deviation, false},
         std::move(joints),
         0,
         true});
  }
  return actions;
}

std::vector<Point> places_of(std::span<const UncertainAction> actions, const Structure& structure) {
  std::vector<Point> places;
  for (const UncertainAction& action : actions)
    places.push_back(middle_of(structure.joints[action.joints.front()], structure.mesh));
  return places;
}

UncertainParameters uncertain_parameters(const Structure& structure, const Uncertainty& uncertainty) {
  UncertainParameters result;
  const std::vector<std::size_t> joints = all_joints(structure);
  if (!joints.empty()) {
    add_factor(result.of_bridge, UncertainQuantity::stiffness, "stiffness", uncertainty.common_stiffness,
               joints);
    add_factor(result.of_bridge, UncertainQuantity::stiffness_ratio, "stiffness ratio",
               uncertainty.stiffness_ratio, joints);
    add_factor(result.of_bridge, UncertainQuantity::friction, "friction", uncertainty.friction, joints);
  }
  add_factor(result.of_bridge, UncertainQuantity::young_modulus, "young modulus", uncertainty.young_modulus);
  add_factor(result.of_bridge, UncertainQuantity::density, "density", uncertainty.density);
  add_own_stiffness(structure, uncertainty, result);

  add_of_epoch(result.of_epoch, UncertainQuantity::temperature, kTemperature, "K", uncertainty.temperature);
  for (std::size_t s = 0; s < structure.supports.size(); ++s) {
    const Support& support = structure.supports[s];
    const double sigma = support.is_foot ? uncertainty.foot_movement : uncertainty.side_movement;
    if (support.holds_x)
      add_of_epoch(result.of_epoch, UncertainQuantity::movement_x, support.name + " dx", "m", sigma, s);
    if (support.holds_y)
      add_of_epoch(result.of_epoch, UncertainQuantity::movement_y, support.name + " dy", "m", sigma, s);
    if (support.is_foot && turns(support))
      add_of_epoch(result.of_epoch, UncertainQuantity::rotation, support.name + " rotation", "rad",
                   uncertainty.foot_rotation, s);
  }
  if (uncertainty.epoch_stiffness > 0.0 && !joints.empty())
    result.of_epoch.push_back({UncertainQuantity::stiffness,
                               {kEpochStiffness, "1", log_deviation(uncertainty.epoch_stiffness), true},
                               joints});
  return result;
}

bool has_uncertain_parameters(const Structure& structure, const Uncertainty& uncertainty) {
  const bool has_own = uncertainty.joint_stiffness > 0.0 || uncertainty.regional_stiffness > 0.0;
  if (has_own && !structure.joints.empty()) return true;
  return !uncertain_parameters(structure, uncertainty).all().empty();
}

Parameters parameters_at(const Model& bridge, const UncertainParameters& uncertain,
                         const Eigen::VectorXd& theta) {
  Parameters parameters = bridge.parameters;
  for (std::size_t i = 0; i < uncertain.of_bridge.size(); ++i)
    apply(uncertain.of_bridge[i], theta[static_cast<Eigen::Index>(i)], parameters);
  parameters.contact = drawn_contact(parameters.joints, bridge.parameters);
  return parameters;
}

Stage in_epoch(Stage stage, const Structure& structure, const UncertainParameters& uncertain,
               const Eigen::VectorXd& theta) {
  stage.support_movement = Field::Zero(2, structure.mesh.node_count());
  for (std::size_t i = 0; i < uncertain.of_epoch.size(); ++i) {
    const UncertainAction& action = uncertain.of_epoch[i];
    const double value = action.parameter.sigma * theta[static_cast<Eigen::Index>(i)];
    if (action.quantity == UncertainQuantity::temperature)
      stage.temperature += value;
    else if (action.quantity == UncertainQuantity::stiffness)
      stage.joint_stiffness =
          Eigen::ArrayXd::Constant(static_cast<Eigen::Index>(structure.joints.size()), std::exp(value));
    else
      stage.support_movement += movement_of(structure, action, value);
  }
  return stage;
}

Eigen::VectorXd sampled_theta(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  Eigen::VectorXd theta(static_cast<Eigen::Index>(count));
  for (double& value : theta) value = random.gaussian();
  return theta;
}

Parameters sampled_parameters(const Model& bridge, const UncertainParameters& uncertain, std::uint64_t seed) {
  return parameters_at(bridge, uncertain,
                       uncertain.correlation_factor * sampled_theta(uncertain.of_bridge.size(), seed));
}

Model sampled(const Model& bridge, const Uncertainty& uncertainty, std::uint64_t seed) {
  return with_parameters(bridge, sampled_parameters(bridge, uncertain_parameters(bridge, uncertainty), seed));
}

Field movement_of(const Structure& structure, const UncertainAction& action, double value) {
  switch (action.quantity) {
    case UncertainQuantity::movement_x:
      return rigid_movement(structure, action.support, {value, 0.0}, 0.0);
    case UncertainQuantity::movement_y:
      return rigid_movement(structure, action.support, {0.0, value}, 0.0);
    case UncertainQuantity::rotation:
      return rigid_movement(structure, action.support, {0.0, 0.0}, value);
    default:
      return Field::Zero(2, structure.mesh.node_count());
  }
}

}  // namespace voussoir
