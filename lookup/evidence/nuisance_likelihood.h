#pragma once
/// @file Gaussian readings with unknowns that are no damage, marginalised in closed form: they are linear and
/// Gaussian, too.

#include <Eigen/Cholesky>
#include <span>
#include <vector>

#include "lookup/evidence/row_statistics.h"

namespace voussoir {

/// The covariance of a row's readings is D + Phi Phi', D the diagonal of the squared scales and Phi the
/// nuisance columns times their prior deviations (Observation::levelling, and unknown_scale times the
/// movements). `sum_square` is y' (D + Phi Phi')^-1 y of the differences y, `sum_log_scale` half the
/// logarithm of the determinant, so that the Gaussian likelihood follows from them as it does without
/// unknowns (Woodbury's identity and the matrix determinant lemma); `sum_absolute` says with NaN that a scene
/// is impossible.
TableStatistics nuisance_statistics(const Observation& observation, double level, const SceneTable& table,
                                    std::span<const std::size_t> rows);

/// What the nuisances add to each of a scene's readings [m], as they are likeliest after the readings; 0
/// where there is none. `deviations` [m]: of instrument and model.
Eigen::ArrayXd fitted_nuisances(const Observation& observation, std::span<const double> prediction,
                                std::span<const double> deviations);

/// The same of one row after the other, each at many levels.
class NuisanceStatistics {
 public:
  /// Precondition: has_levelling.
  explicit NuisanceStatistics(const Observation& observation);

  /// From now on it is this row, with its common_variance.
  void take(std::span<const double> prediction, double common);

  RowStatistics at(double level);

 private:
  std::vector<std::size_t> point_;  // that have a reading
  Eigen::ArrayXd reading_, share_, floor_, intact_, origin_, own_variance_;
  Eigen::MatrixXd levelling_;  // readings x columns
  Eigen::MatrixXd products_;   // of two levellings' columns each: readings x pairs
  double share_square_, unknown_scale_;
  Eigen::ArrayXd difference_, movement_, slope_, model_variance_, variance_, weight_;  // of the row
  Eigen::VectorXd right_, squares_, weighted_, column_;
  Eigen::MatrixXd normal_;
  Eigen::LLT<Eigen::MatrixXd> factorised_;
};

}  // namespace voussoir
