#pragma once
/// @file How well something beside the intact bridge explains readings, from the definition of a Gaussian
/// (LDLT): the oracle of what looks for such causes.

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "lookup/unknown/case_noise.h"
#include "tests/lookup/unknown/dense_normal.h"

namespace voussoir::test {

inline constexpr std::array<UnknownCase, 2> kTwoCases = {{{0.0, 1.0}, {0.0, 0.2}}};

inline Eigen::MatrixXd intact_covariance_of(const UnknownBridge& bridge, const CaseNoise& noise) {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(bridge.reading.size());
  const Eigen::MatrixXd scatter = bridge_columns(bridge, Scene{});
  return scene_noise(bridge, noise, {{}, zero, zero}) + scatter * scatter.transpose();
}

struct Explained {
  double log = -std::numeric_limits<double>::infinity();  ///< density but for the constant of a Gaussian
  Eigen::VectorXd amounts;                                ///< most likely ones
};

/// By N(0, 1) times each of these columns, in the likeliest of kTwoCases.
inline Explained explained_by(const UnknownBridge& bridge, const Observation& observation,
                              const Eigen::MatrixXd& columns) {
  Explained best;
  for (const UnknownCase& one : kTwoCases) {
    const Eigen::MatrixXd covariance =
        intact_covariance_of(bridge, case_noise(bridge, observation, one)) + columns * columns.transpose();
    const double log = log_normal(bridge.reading, covariance);
    if (log > best.log) best = {log, columns.transpose() * covariance.ldlt().solve(bridge.reading)};
  }
  best.log += 0.5 * static_cast<double>(bridge.reading.size()) * std::log(2.0 * std::numbers::pi);
  return best;
}

}  // namespace voussoir::test
