#include "lookup/evidence/nuisance_likelihood.h"

#include <algorithm>
#include <cmath>

#include "lookup/readings/common_variance.h"
#include "lookup/readings/noise_scale.h"

namespace voussoir {
namespace {

/// Logarithms of products of a few: variances lie within 1e+-30 of one.
double sum_of_logarithms(const Eigen::ArrayXd& values) {
  constexpr Eigen::Index kTogether = 8;
  double sum = 0.0;
  for (Eigen::Index i = 0; i < values.size(); i += kTogether)
    sum += std::log(values.segment(i, std::min(kTogether, values.size() - i)).prod());
  return sum;
}

}  // namespace

NuisanceStatistics::NuisanceStatistics(const Observation& observation)
    : point_(observation.channels_read()),
      share_square_(observation.error_share * observation.error_share),
      unknown_scale_(observation.unknown_scale) {
  const auto readings = static_cast<Eigen::Index>(point_.size());
  const auto gathered = [&](const std::vector<double>& values) {
    Eigen::ArrayXd result(readings);
    for (std::size_t k = 0; k < point_.size(); ++k) result[static_cast<Eigen::Index>(k)] = values[point_[k]];
    return result;
  };
  reading_ = gathered(observation.reading);
  share_ = gathered(observation.share);
  floor_ = gathered(observation.floor);
  intact_ = gathered(observation.intact);
  origin_ = gathered(observation.origin);
  own_variance_ = gathered(observation.own_variance);
  const Eigen::Index levellings = observation.levelling.cols();
  levelling_.resize(readings, levellings);
  for (Eigen::Index k = 0; k < readings; ++k)
    levelling_.row(k) =
        observation.levelling.row(static_cast<Eigen::Index>(point_[static_cast<std::size_t>(k)]));
  products_.resize(readings, levellings * (levellings + 1) / 2);
  for (Eigen::Index j = 0, k = 0; j < levellings; ++j)
    for (Eigen::Index i = j; i < levellings; ++i)
      products_.col(k++) = levelling_.col(i).cwiseProduct(levelling_.col(j));
  const Eigen::Index columns = levellings + (unknown_scale_ > 0.0 ? 1 : 0);
  normal_.setZero(columns, columns);
  right_.resize(columns);
  movement_.resize(readings);
}

void NuisanceStatistics::take(std::span<const double> prediction, double common) {
  for (std::size_t k = 0; k < point_.size(); ++k)
    movement_[static_cast<Eigen::Index>(k)] = prediction[point_[k]];
  model_variance_ =
      model_variance<Eigen::ArrayXd>(own_variance_ + common, share_square_, movement_ - intact_);
  difference_ = reading_ - movement_;
  movement_ -= origin_;
  slope_ = share_ * (movement_.abs() + kSmallestMovement);
}

/// With the columns Phi, those of levellings first, and D the diagonal of the variances: 1 + Phi' D^-1 Phi
/// and Phi' D^-1 y.
RowStatistics NuisanceStatistics::at(double level) {
  RowStatistics result;
  result.sum_absolute = difference_.abs().sum();
  if (std::isnan(result.sum_absolute)) return result;
  const Eigen::Index levellings = levelling_.cols();
  variance_ = (level * slope_ + floor_).square() + model_variance_;
  weight_ = variance_.inverse();
  weighted_ = (weight_ * difference_).matrix();
  squares_.noalias() = products_.transpose() * weight_.matrix();
  for (Eigen::Index j = 0, k = 0; j < levellings; ++j)
    for (Eigen::Index i = j; i < levellings; ++i) normal_(i, j) = squares_[k++];
  right_.head(levellings).noalias() = levelling_.transpose() * weighted_;
  if (unknown_scale_ > 0.0) {
    column_ = (unknown_scale_ * movement_ * weight_).matrix();
    normal_.row(levellings).head(levellings).noalias() = column_.transpose() * levelling_;
    normal_(levellings, levellings) = unknown_scale_ * column_.dot(movement_.matrix());
    right_[levellings] = column_.dot(difference_.matrix());
  }
  normal_.diagonal().array() += 1.0;
  factorised_.compute(normal_);  // looks at the lower half
  factorised_.matrixL().solveInPlace(right_);
  result.sum_square = weighted_.dot(difference_.matrix()) - right_.squaredNorm();
  result.sum_log_scale =
      0.5 * sum_of_logarithms(variance_) + factorised_.matrixLLT().diagonal().array().log().sum();
  return result;
}

Eigen::ArrayXd fitted_nuisances(const Observation& observation, std::span<const double> prediction,
                                std::span<const double> deviations) {
  const auto points = static_cast<Eigen::Index>(prediction.size());
  Eigen::MatrixXd columns(points, observation.levelling.cols() + 1);
  Eigen::ArrayXd weight = Eigen::ArrayXd::Zero(points), difference = weight;
  columns.leftCols(observation.levelling.cols()) = observation.levelling;
  for (Eigen::Index i = 0; i < points; ++i) {
    const auto point = static_cast<std::size_t>(i);
    columns(i, columns.cols() - 1) =
        observation.unknown_scale * (prediction[point] - observation.origin[point]);
    if (std::isnan(observation.reading[point]) || std::isnan(prediction[point])) {
      columns.row(i).setZero();
      continue;
    }
    weight[i] = 1.0 / (deviations[point] * deviations[point]);
    difference[i] = observation.reading[point] - prediction[point];
  }
  Eigen::MatrixXd normal = columns.transpose() * weight.matrix().asDiagonal() * columns;
  normal.diagonal().array() += 1.0;
  return columns * normal.llt().solve(columns.transpose() * (weight * difference).matrix());
}

TableStatistics nuisance_statistics(const Observation& observation, double level, const SceneTable& table,
                                    std::span<const std::size_t> rows) {
  const std::vector<double> common =
      common_variances(observation.intact, observation.error_common, table, rows);
  const std::vector<double> zeros(rows.size(), 0.0);
  TableStatistics result{zeros, zeros, zeros, zeros, zeros, zeros};
  NuisanceStatistics statistics(observation);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    statistics.take(table.row(rows[i]), common[i]);
    const RowStatistics one = statistics.at(level);
    result.sum_absolute[i] = one.sum_absolute;
    result.sum_square[i] = one.sum_square;
    result.sum_log_scale[i] = one.sum_log_scale;
  }
  return result;
}

}  // namespace voussoir
