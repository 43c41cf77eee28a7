#include "lookup/evidence/nuisance_likelihood.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "lookup/readings/common_variance.h"
#include "lookup/readings/noise_scale.h"

namespace voussoir {
namespace {

/// The arrays of an observation at its points with readings, one after the other.
struct Readings {
  std::vector<std::size_t> point;
  Eigen::ArrayXd reading, slope, offset, intact, origin, own_variance;
  Eigen::MatrixXd levelling;  // readings x columns

  Readings(const Observation& observation, const ErrorScales& scales) {
    for (std::size_t i = 0; i < observation.reading.size(); ++i)
      if (!std::isnan(observation.reading[i])) point.push_back(i);
    const auto gathered = [&](const std::vector<double>& values) {
      Eigen::ArrayXd result(static_cast<Eigen::Index>(point.size()));
      for (std::size_t k = 0; k < point.size(); ++k) result[static_cast<Eigen::Index>(k)] = values[point[k]];
      return result;
    };
    reading = gathered(observation.reading);
    slope = gathered(scales.slope);
    offset = gathered(scales.offset);
    intact = gathered(observation.intact);
    origin = gathered(observation.origin);
    own_variance = gathered(observation.own_variance);
    levelling.resize(reading.size(), observation.levelling.cols());
    for (Eigen::Index k = 0; k < reading.size(); ++k)
      levelling.row(k) =
          observation.levelling.row(static_cast<Eigen::Index>(point[static_cast<std::size_t>(k)]));
  }
};

/// Logarithms of products of a few: variances lie within 1e+-30 of one.
double sum_of_logarithms(const Eigen::ArrayXd& values) {
  constexpr Eigen::Index kTogether = 8;
  double sum = 0.0;
  for (Eigen::Index i = 0; i < values.size(); i += kTogether)
    sum += std::log(values.segment(i, std::min(kTogether, values.size() - i)).prod());
  return sum;
}

/// What the rows share, and the vectors that are worked in.
class RowSolver {
 public:
  RowSolver(const Observation& observation, const ErrorScales& scales)
      : readings_(observation, scales),
        share_square_(observation.error_share * observation.error_share),
        unknown_scale_(observation.unknown_scale),
        products_(readings_.reading.size(),
                  readings_.levelling.cols() * (readings_.levelling.cols() + 1) / 2),
        prediction_(readings_.reading.size()) {
    const Eigen::Index levellings = readings_.levelling.cols();
    const Eigen::Index columns = levellings + (unknown_scale_ > 0.0 ? 1 : 0);
    normal_.setZero(columns, columns);
    right_.resize(columns);
    for (Eigen::Index j = 0, k = 0; j < levellings; ++j)
      for (Eigen::Index i = j; i < levellings; ++i)
        products_.col(k++) = readings_.levelling.col(i).cwiseProduct(readings_.levelling.col(j));
  }

  RowStatistics operator()(std::span<const double> row, double common) {
    for (std::size_t k = 0; k < readings_.point.size(); ++k)
      prediction_[static_cast<Eigen::Index>(k)] = row[readings_.point[k]];
    difference_ = readings_.reading - prediction_;
    RowStatistics result;
    result.sum_absolute = difference_.abs().sum();
    if (std::isnan(result.sum_absolute)) return result;
    movement_ = prediction_ - readings_.origin;
    instrument_ = noise_scale<Eigen::ArrayXd>(readings_.slope, readings_.offset, movement_.abs());
    variance_ =
        instrument_.square() + model_variance<Eigen::ArrayXd>(readings_.own_variance + common, share_square_,
                                                              prediction_ - readings_.intact);
    return with_columns(result);
  }

 private:
  /// With the columns Phi, those of levellings first, and D the diagonal of the variances: 1 + Phi' D^-1 Phi
  /// and Phi' D^-1 y.
  RowStatistics with_columns(RowStatistics result) {
    const Eigen::Index levellings = readings_.levelling.cols();
    weight_ = variance_.inverse();
    weighted_ = (weight_ * difference_).matrix();
    squares_.noalias() = products_.transpose() * weight_.matrix();
    for (Eigen::Index j = 0, k = 0; j < levellings; ++j)
      for (Eigen::Index i = j; i < levellings; ++i) normal_(i, j) = squares_[k++];
    right_.head(levellings).noalias() = readings_.levelling.transpose() * weighted_;
    if (unknown_scale_ > 0.0) {
      column_ = (unknown_scale_ * movement_ * weight_).matrix();
      normal_.row(levellings).head(levellings).noalias() = column_.transpose() * readings_.levelling;
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

  Readings readings_;
  double share_square_;
  double unknown_scale_;
  Eigen::MatrixXd products_;  // of two levellings' columns each: readings x pairs
  Eigen::MatrixXd normal_;
  Eigen::VectorXd right_, squares_, weighted_, column_;
  Eigen::ArrayXd prediction_, movement_, difference_, instrument_, variance_, weight_;
  Eigen::LLT<Eigen::MatrixXd> factorised_;
};

}  // namespace

TableStatistics nuisance_statistics(const Observation& observation, const ErrorScales& scales,
                                    const SceneTable& table, std::span<const std::size_t> rows) {
  const std::vector<double> common =
      common_variances(observation.intact, observation.error_common, table, rows);
  const std::vector<double> zeros(rows.size(), 0.0);
  TableStatistics result{zeros, zeros, zeros, zeros, zeros, zeros};
  RowSolver solve(observation, scales);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const RowStatistics one = solve(table.row(rows[i]), common[i]);
    result.sum_absolute[i] = one.sum_absolute;
    result.sum_square[i] = one.sum_square;
    result.sum_log_scale[i] = one.sum_log_scale;
  }
  return result;
}

}  // namespace voussoir
