#include "lookup/report/bridge_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/structure/uncertain_parameters.h"

namespace voussoir {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Parameters of single joints are the only ones with names of two blocks: "stiffness 4,3/5,3".
bool is_of_joint(const UncertainParameter& parameter) {
  return parameter.name.find('/') != std::string::npos;
}

/// What readings that say nothing leave as it is: kappa makes the bridge's variances uncertain, the sizes of
/// conditions those of an epoch.
double spread_beforehand_of_bridge() {
  double mean = 0.0;
  for (std::size_t k = 0; k < kScatterFactors.size(); ++k) mean += kScatterPrior[k] * kScatterFactors[k];
  return std::sqrt(mean);
}
double spread_beforehand_of_epochs() {
  double mean = 0.0;
  for (const double size : kConditionSizes) mean += size * size / kConditionSizes.size();
  return std::sqrt(mean);
}

/// Parameters of the bridge and those of epochs lie one behind the other.
std::size_t first_of_epochs(const ReadingFactors& factors) {
  return factors.parameters().size() - static_cast<std::size_t>(factors.epoch_parameters());
}

KnownParameter in_own_unit(const UncertainParameter& parameter, double before, double mean,
                           double deviation) {
  return {parameter.name, parameter.unit, parameter.sigma * before, parameter.sigma * mean,
          parameter.sigma * deviation};
}

/// The logarithm of a factor on what the file states.
bool is_factor(const KnownParameter& parameter) {
  return parameter.unit == "1";
}

/// In per cent, what a factor with this logarithm changes.
double change_by(double logarithm) {
  return 100.0 * std::expm1(logarithm);
}

/// With a decimal where it is known to less than a per cent.
std::string share_in_words(double logarithm, double deviation) {
  const int decimals = deviation < 0.01 ? 1 : 0;
  const double step = std::pow(10.0, decimals);
  return fmt::format("{:+.{}f}", std::round(step * change_by(logarithm)) / step + 0.0, decimals);  // no -0
}

std::string range_of_factor(double mean, double deviation) {
  return fmt::format("{} to {} %", share_in_words(mean - deviation, deviation),
                     share_in_words(mean + deviation, deviation));
}

struct ShownUnit {
  std::string name;
  double scale;  ///< from the parameter's own
};
ShownUnit shown_unit(const std::string& unit) {
  if (unit == "m") return {"mm", 1e3};
  if (unit == "rad") return {"mrad", 1e3};
  return {unit, 1.0};
}

/// As many as a standard deviation of two digits has.
int decimals_of(double deviation) {
  return deviation > 0.0 ? std::clamp(1 - static_cast<int>(std::floor(std::log10(deviation))), 0, 9) : 2;
}

}  // namespace

std::vector<Cause> causes_of(const BridgeAnswer& bridge, const ReadingFactors& factors) {
  const auto& [model, posterior] = bridge;
  VectorXd counts(model.reading.size());
  for (Index k = 0; k < counts.size(); ++k)
    counts[k] = model.rows[static_cast<std::size_t>(k)].after != 0.0 ? 1.0 : 0.0;
  const VectorXd all = model.reading.cwiseProduct(counts);
  std::vector<Cause> causes;
  const auto add = [&](std::string name, const VectorXd& part) {
    const double size = part.cwiseProduct(counts).norm() / std::sqrt(std::max(1.0, counts.sum()));
    causes.push_back({std::move(name), all.isZero(0.0) ? 0.0 : part.dot(all) / all.squaredNorm(), size});
  };
  VectorXd temperature = VectorXd::Zero(counts.size()), supports = temperature, joints = temperature;
  for (Index i = 0; i < posterior.from_epochs.cols(); ++i) {
    const std::string& name =
        factors.parameters()[first_of_epochs(factors) + static_cast<std::size_t>(i)].name;
    (name == kTemperature      ? temperature
     : name == kEpochStiffness ? joints
                               : supports) += posterior.from_epochs.col(i);
  }
  add("missing blocks", posterior.signal);
  add("the bridge itself", posterior.from_bridge);
  add(kTemperature, temperature);
  add("supports", supports);
  add(kEpochStiffness, joints);
  add("uneven warmth and stiffness", posterior.from_unevenness);
  add("what is left", posterior.left);
  return causes;
}

double KnownParameter::news() const {
  return std::abs(mean) / deviation_before + std::abs(std::log(deviation / deviation_before));
}

std::vector<KnownParameter> known_of_bridge(const BridgeAnswer& bridge, const ReadingFactors& factors,
                                            std::size_t most_joints) {
  const Eigen::MatrixXd& basis = factors.sensitivities->basis;
  const VectorXd mean = basis * bridge.posterior.bridge_mean;
  std::vector<std::size_t> order(static_cast<std::size_t>(mean.size()));
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto is_joint = [&](std::size_t i) { return is_of_joint(factors.parameters()[i]); };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (is_joint(a) != is_joint(b)) return is_joint(b);
    return std::abs(mean[static_cast<Index>(a)]) > std::abs(mean[static_cast<Index>(b)]);
  });
  std::vector<KnownParameter> result;
  std::size_t joints = 0;
  for (const std::size_t i : order) {
    if (is_joint(i) && ++joints > most_joints) break;
    const ParameterEstimate one = parameter_estimate(bridge.posterior, basis.row(static_cast<Index>(i)));
    result.push_back(
        in_own_unit(factors.parameters()[i], spread_beforehand_of_bridge(), one.mean, one.deviation));
  }
  return result;
}

std::vector<KnownParameter> known_of_epochs(const BridgeAnswer& bridge, const ReadingFactors& factors) {
  const auto& [model, posterior] = bridge;
  const Index columns = factors.of_epoch();
  std::vector<KnownParameter> result;
  if (model.conditions == Conditions::known) return result;
  for (Index i = 0; i < factors.epoch_parameters(); ++i) {
    VectorXd weights = VectorXd::Zero(posterior.epoch_mean.size());
    weights[weights.size() - columns + i] = 1.0;
    if (model.epochs > 1) weights[i] = -1.0;
    const auto& parameter = factors.parameters()[first_of_epochs(factors) + static_cast<std::size_t>(i)];
    result.push_back(in_own_unit(
        parameter, spread_beforehand_of_epochs() * weights.norm(), weights.dot(posterior.epoch_mean),
        std::sqrt(std::max(0.0, weights.dot(posterior.epoch_covariance * weights)))));
  }
  return result;
}

std::string before_in_words(const KnownParameter& parameter) {
  if (is_factor(parameter)) return range_of_factor(0.0, parameter.deviation_before);
  const auto [unit, scale] = shown_unit(parameter.unit);
  return fmt::format("+- {:.2g} {}", scale * parameter.deviation_before, unit);
}

std::string after_in_words(const KnownParameter& parameter) {
  if (is_factor(parameter))
    return fmt::format("{} % ({})", share_in_words(parameter.mean, parameter.deviation),
                       range_of_factor(parameter.mean, parameter.deviation));
  const auto [unit, scale] = shown_unit(parameter.unit);
  const double deviation = scale * parameter.deviation;
  return fmt::format("{:+.{}f} +- {:.2g} {}", scale * parameter.mean, decimals_of(deviation), deviation,
                     unit);
}

std::string in_words(const KnownParameter& parameter) {
  return fmt::format("{}: {}, before {}", parameter.name, after_in_words(parameter),
                     before_in_words(parameter));
}

std::string causes_in_words(const std::vector<Cause>& causes) {
  std::string text;
  for (const Cause& cause : causes)
    text += fmt::format("{}{} {:.0f} %", text.empty() ? "" : ", ", cause.name,
                        std::round(100.0 * cause.share) + 0.0);
  return text;
}

}  // namespace voussoir
