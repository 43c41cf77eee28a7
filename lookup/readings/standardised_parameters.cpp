#include "lookup/readings/standardised_parameters.h"

#include <cmath>

namespace voussoir {
namespace {

using Values = std::vector<double> VariantParameters::*;

/// The logarithm of a variant's value over the nominal one.
class LogRatio {
 public:
  LogRatio(const VariantParameters& nominal, const VariantParameters& variant)
      : nominal_(nominal), variant_(variant) {}

  double operator()(Values values, std::size_t place) const {
    return std::log((variant_.*values)[place] / (nominal_.*values)[place]);
  }

 private:
  const VariantParameters& nominal_;
  const VariantParameters& variant_;
};

/// Of what one factor acts on alike: at any of its places.
double log_factor(const UncertainAction& action, const LogRatio& log_ratio) {
  switch (action.quantity) {
    case UncertainQuantity::stiffness:
      return log_ratio(&VariantParameters::normal_stiffness, action.joints.front());
    case UncertainQuantity::stiffness_ratio:
      return log_ratio(&VariantParameters::tangential_stiffness, action.joints.front()) -
             log_ratio(&VariantParameters::normal_stiffness, action.joints.front());
    case UncertainQuantity::friction:
      return log_ratio(&VariantParameters::friction_coefficient, action.joints.front());
    case UncertainQuantity::young_modulus:
      return log_ratio(&VariantParameters::young_modulus, 0);
    case UncertainQuantity::density:
      return log_ratio(&VariantParameters::density, 0);
    default:
      return 0.0;  // of an epoch
  }
}

bool is_common_stiffness(const UncertainAction& action) {
  return action.quantity == UncertainQuantity::stiffness && !action.has_mean_one;
}

/// What is left for the common stiffness: the mean of what joints' own factors are beyond their medians; if
/// joints have none of their own, all.
double common_log_stiffness(const UncertainParameters& uncertain, const LogRatio& log_ratio) {
  double sum = 0.0, own = 0.0;
  const UncertainAction* common = nullptr;
  for (const UncertainAction& action : uncertain.of_bridge) {
    if (is_common_stiffness(action)) common = &action;
    if (action.quantity != UncertainQuantity::stiffness || !action.has_mean_one) continue;
    sum += log_factor(action, log_ratio) + 0.5 * action.parameter.sigma * action.parameter.sigma;
    own += 1.0;
  }
  if (common == nullptr) return 0.0;
  return own > 0.0 ? sum / own : log_factor(*common, log_ratio);
}

}  // namespace

Eigen::VectorXd standardised_parameters(const UncertainParameters& uncertain,
                                        const VariantParameters& nominal, const VariantParameters& variant) {
  const LogRatio log_ratio(nominal, variant);
  const double common = common_log_stiffness(uncertain, log_ratio);
  Eigen::VectorXd theta(static_cast<Eigen::Index>(uncertain.of_bridge.size()));
  for (std::size_t i = 0; i < uncertain.of_bridge.size(); ++i) {
    const UncertainAction& action = uncertain.of_bridge[i];
    const double s = action.parameter.sigma;
    double log = is_common_stiffness(action) ? common : log_factor(action, log_ratio);
    if (action.has_mean_one) log += 0.5 * s * s - common;
    theta[static_cast<Eigen::Index>(i)] = log / s;
  }
  return theta;
}

}  // namespace voussoir
