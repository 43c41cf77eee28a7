#include "lookup/evidence/nuisance.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.h"
#include "lookup/evidence/evidence.h"
#include "lookup/evidence/scene_evidence.h"
#include "lookup/readings/noise_scale.h"

namespace voussoir {
namespace {

constexpr double kImpossible = -std::numeric_limits<double>::infinity();
constexpr int kPanels = 24;  // of the quadrature over the logarithm of the level
constexpr double kLeastScale =
    1e-3;  // of the fitted factor, so that a scene cannot explain readings as noise-free
constexpr std::size_t kMostTerms = 3;

/// The readings of one scene with the nuisance terms diagonalised. With W = 1 / scale_i^2 (for level 1), Phi
/// the nuisance columns times their prior deviations and y the differences, Phi' W Phi = V diag(e) V' and g =
/// V' Phi' W y. At noise level s: -2 log p = n log 2 pi + 2 sum log scale + 2 n log s + sum log(1 + e_k /
/// s^2)
///                              + (y' W y - sum g_k^2 / (s^2 + e_k)) / s^2.
struct Reduced {
  double count = 0.0;
  double sum_log_scale = 0.0;
  double square = 0.0;
  Eigen::Vector3d e = Eigen::Vector3d::Zero();
  Eigen::Vector3d g = Eigen::Vector3d::Zero();

  double log_likelihood(double level) const {
    const double s2 = level * level;
    double result = count * std::log(2.0 * std::numbers::pi * s2) + 2.0 * sum_log_scale + square / s2;
    for (std::size_t k = 0; k < kMostTerms; ++k)
      result += std::log1p(e[static_cast<int>(k)] / s2) -
                g[static_cast<int>(k)] * g[static_cast<int>(k)] / (s2 + e[static_cast<int>(k)]) / s2;
    return -0.5 * result;
  }
};

/// Mean of reading / prediction weighted by the prediction: least squares, kept positive.
double fitted_factor(const Observation& observation, std::span<const double> prediction) {
  double product = 0.0, square = 0.0;
  for (std::size_t i = 0; i < prediction.size(); ++i) {
    if (std::isnan(observation.reading[i])) continue;
    product += observation.reading[i] * prediction[i];
    square += prediction[i] * prediction[i];
  }
  return square > 0.0 ? std::max(product / square, kLeastScale) : 1.0;
}

class NuisanceModel {
 public:
  NuisanceModel(const Observation& observation, double level, const std::vector<StoredPoint>& points,
                const Nuisance& nuisance)
      : observation_(observation),
        scales_(scales_at(observation, level)),
        points_(points),
        nuisance_(nuisance) {
    for (std::size_t i = 0; i < points.size(); ++i)
      if (!std::isnan(observation.reading[i]))
        mean_x_ += points[i].position.x() / static_cast<double>(observation.count);
  }

  /// Nothing is possible (a NaN in `square`) if a reading has no prediction.
  Reduced reduce(std::span<const double> prediction) const {
    const double factor = nuisance_.scale > 0.0 ? fitted_factor(observation_, prediction) : 1.0;
    Reduced result;
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < prediction.size(); ++i) {
      if (std::isnan(observation_.reading[i])) continue;
      const double scale =
          noise_scale(scales_.slope[i] * factor, scales_.offset[i], std::abs(prediction[i]),
                      observation_.noise.model_error, std::abs(prediction[i] - observation_.intact[i]));
      const double difference = (observation_.reading[i] - prediction[i]) / scale;
      const Eigen::Vector3d terms = Eigen::Vector3d(nuisance_.scale * prediction[i], nuisance_.datum,
                                                    nuisance_.tilt * (points_[i].position.x() - mean_x_)) /
                                    scale;
      normal += terms * terms.transpose();
      right += terms * difference;
      result.square += difference * difference;
      result.sum_log_scale += std::log(scale);
      result.count += 1.0;
    }
    if (std::isnan(result.square)) return result;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(normal);
    result.e = eigen.eigenvalues().cwiseMax(0.0);
    result.g = eigen.eigenvectors().transpose() * right;
    return result;
  }

 private:
  const Observation& observation_;
  ErrorScales scales_;
  const std::vector<StoredPoint>& points_;
  const Nuisance& nuisance_;
  double mean_x_ = 0.0;  // [m] of the points with readings
};

/// log of the mean over log-uniform levels.
double log_evidence(const Reduced& reduced) {
  const double first = std::log(kSmallestLevel);
  const double width = (std::log(kLargestLevel) - first) / kPanels;
  double sum = kImpossible;
  for (int panel = 0; panel < kPanels; ++panel) {
    const double from = first + panel * width;
    const double top =
        std::max({reduced.log_likelihood(std::exp(from)), reduced.log_likelihood(std::exp(from + width)),
                  reduced.log_likelihood(std::exp(from + width / 2.0))});
    const auto density = [&](double u) { return std::exp(reduced.log_likelihood(std::exp(u)) - top); };
    const double integral =
        boost::math::quadrature::gauss<double, 15>::integrate(density, from, from + width);
    sum = log_sum(sum, top + std::log(integral));
  }
  return sum - std::log(kPanels * width);
}

}  // namespace

std::vector<double> log_evidence_with_nuisance(const Observation& observation, const SceneTable& table,
                                               std::span<const std::size_t> rows,
                                               const std::vector<StoredPoint>& points,
                                               const Nuisance& nuisance) {
  const NoiseModel& noise = observation.noise;
  if (noise.shape != NoiseShape::gaussian)
    throw InputError("an unknown scale, datum or tilt needs Gaussian noise, expected --noise-model gaussian");
  if (!noise.relative && observation.has_absolute_errors())
    throw InputError(
        "an unknown scale, datum or tilt beside absolute errors needs a noise level, expected --noise");
  require_readings(observation);
  const double level = noise.relative ? std::max(*noise.relative, kSmallestLevel) : 1.0;
  const NuisanceModel model(observation, level, points, nuisance);
  const std::vector<double> log_silence = log_chance_of_silence(observation, table, rows);
  std::vector<double> result(table.rows, kImpossible);
  for (const std::size_t row : rows) {
    const Reduced reduced = model.reduce(table.row(row));
    if (std::isnan(reduced.square)) continue;
    result[row] = log_silence[row] + (noise.relative ? reduced.log_likelihood(1.0) : log_evidence(reduced));
  }
  return result;
}

}  // namespace voussoir
