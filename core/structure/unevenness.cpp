#include "core/structure/unevenness.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "core/geometry/polygon.h"
#include "core/random.h"
#include "core/structure/correlation_by_distance.h"

namespace voussoir {
namespace {

UnevenQuantity stiffness_of(const Structure& structure, double deviation) {
  UnevenQuantity stiffness{own_stiffness(structure, deviation), {}};
  stiffness.correlations = correlations_by_distance(structure, places_of(stiffness.actions, structure));
  return stiffness;
}

UnevenQuantity temperature_of(const Structure& structure, double deviation) {
  UnevenQuantity temperature;
  if (deviation == 0.0) return temperature;
  std::vector<Point> places;
  for (std::size_t b = 0; b < structure.layout.size(); ++b) {
    const Block& block = structure.layout.blocks[b];
    UncertainAction action;
    action.quantity = UncertainQuantity::temperature;
    action.parameter = {fmt::format("temperature {}", block.label), "K", deviation, true};
    action.blocks = {b};
    temperature.actions.push_back(std::move(action));
    places.push_back(centroid(block.polygon));
  }
  temperature.correlations = correlations_by_distance(structure, places);
  return temperature;
}

/// Of each action in its own unit.
Eigen::VectorXd drawn(const UnevenQuantity& quantity, std::uint64_t seed) {
  Eigen::VectorXd values =
      quantity.correlations.llt().matrixL() * sampled_theta(quantity.actions.size(), seed);
  for (std::size_t i = 0; i < quantity.actions.size(); ++i)
    values[static_cast<Eigen::Index>(i)] *= quantity.actions[i].parameter.sigma;
  return values;
}

}  // namespace

Unevenness unevenness_of(const Structure& structure, const Uncertainty& uncertainty) {
  return {stiffness_of(structure, log_deviation(uncertainty.epoch_unevenness)),
          temperature_of(structure, uncertainty.uneven_temperature)};
}

Stage with_unevenness(Stage stage, const Structure& structure, const Unevenness& unevenness,
                      std::uint64_t seed) {
  const Eigen::VectorXd softening = drawn(unevenness.stiffness, seed);
  if (softening.size() > 0 && stage.joint_stiffness.size() == 0)
    stage.joint_stiffness = Eigen::ArrayXd::Ones(static_cast<Eigen::Index>(structure.joints.size()));
  for (Eigen::Index i = 0; i < softening.size(); ++i)
    for (const std::size_t joint : unevenness.stiffness.actions[static_cast<std::size_t>(i)].joints)
      stage.joint_stiffness[static_cast<Eigen::Index>(joint)] *= std::exp(softening[i]);
  stage.uneven_temperature = drawn(unevenness.temperature, series_seed(seed, 1));
  return stage;
}

}  // namespace voussoir
