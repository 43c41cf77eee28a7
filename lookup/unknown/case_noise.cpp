#include "lookup/unknown/case_noise.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "core/median.h"

namespace voussoir {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double kLeastDeviation = 1e-9;  // [m] of an instrument: what the database was solved to
/// What the first order leaves of conditions is far from Gaussian, so it counts for more than its second
/// moments: at once, 53 of 400 intact bridges that were heated and moved were called damaged, twice, 7.
constexpr double kHeavyTails = 2.0;

/// Variance of an instrument's error where something moved by so much. `floor`: of one error's own part.
double instrument_variance(double share, double movement, double floor) {
  const double deviation = share * (std::abs(movement) + kSmallestMovement) + floor;
  return std::max(deviation * deviation, kLeastDeviation * kLeastDeviation);
}

/// Changes have the errors of their difference, in shares of the change. Where both of two epochs count, each
/// has an error of its own, in shares of what it shows, and the first one's is in the change.
void add_instruments(const UnknownBridge& bridge, const Observation& observation, double level,
                     CaseNoise& noise) {
  const auto n = static_cast<Index>(bridge.rows.size());
  noise.instruments.resize(n);
  for (Index k = 0; k < n; ++k) {
    const std::size_t channel = bridge.rows[static_cast<std::size_t>(k)].channel;
    noise.instruments[k] = instrument_variance(observation.share[channel] * level,
                                               observation.reading[channel] - observation.origin[channel],
                                               observation.floor[channel]);
  }
  for (Index k = 0; bridge.has_first_epoch() && k < n / 2; ++k) {
    const Index change = k + n / 2;  // the same channels in the same order
    const std::size_t channel = bridge.rows[static_cast<std::size_t>(k)].channel;
    const double share = observation.share[channel] * level,
                 floor = observation.floor[channel] / std::numbers::sqrt2;
    const double before = bridge.reading[k] + bridge.movement[k];
    const double after = before + observation.reading[channel] - observation.origin[channel];
    noise.instruments[k] = instrument_variance(share, before, floor);
    noise.instruments[change] = noise.instruments[k] + instrument_variance(share, after, floor);
    noise.covariance(k, change) -= noise.instruments[k];
    noise.covariance(change, k) -= noise.instruments[k];
  }
  noise.covariance.diagonal() += noise.instruments;
  noise.least_variance = (bridge.has_first_epoch() ? 1.0 : 0.5) * noise.instruments.minCoeff();
}

/// The median over the known losses; 1 if there are none.
double typical_spread(const UnknownBridge& bridge, double conditions) {
  std::vector<double> shares;
  for (const Loss& loss : std::span(bridge.losses).first(bridge.blocks)) {
    if (!loss.known()) continue;
    const double size = loss.signal.array().isNaN().select(0.0, loss.signal).norm();
    const double variance = loss.bridge_variance + conditions * conditions * loss.epoch_variance;
    if (size > 0.0) shares.push_back(std::sqrt(variance) / size);
  }
  return shares.empty() ? 1.0 : median(shares);
}

}  // namespace

/// What heat and moved supports do beyond the first order grows with the square of their size; of little heat
/// as much as with the size itself, to be careful.
CaseNoise case_noise(const UnknownBridge& bridge, const Observation& observation, const UnknownCase& one) {
  const double left = one.conditions * std::max(1.0, kHeavyTails * one.conditions);
  CaseNoise noise;
  noise.conditions = one.conditions;
  noise.covariance = bridge.fixed_noise + left * left * bridge.epoch_noise;
  add_instruments(bridge, observation, one.level, noise);
  noise.spread = typical_spread(bridge, one.conditions);
  return noise;
}

MatrixXd scene_noise(const UnknownBridge& bridge, const CaseNoise& noise, const SceneLoss& loss) {
  MatrixXd covariance = noise.covariance;
  const MatrixXd epoch = noise.conditions * epoch_columns(bridge, loss), others = other_columns(bridge, loss);
  covariance.noalias() += epoch * epoch.transpose() + others * others.transpose();
  const double square = noise.spread * noise.spread;
  covariance.noalias() += square * loss.beyond * loss.beyond.transpose();
  for (Index k = 0; k < covariance.rows(); ++k)
    if (bridge.rows[static_cast<std::size_t>(k)].after != 0.0)
      covariance(k, k) += square * loss.square_at_points;
  return covariance;
}

}  // namespace voussoir
