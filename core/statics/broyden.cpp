#include "core/statics/broyden.h"

namespace voussoir {

Eigen::VectorXd BroydenSecants::step(const Eigen::VectorXd& solution) const {
  /// Beyond it the updated matrix is nearly singular, and the step is taken without its last update.
  constexpr double kLargestShare = 0.9;
  Eigen::VectorXd step = solution;
  for (std::size_t j = 0; j + 1 < taken_.size(); ++j)
    step += (taken_[j].dot(step) / taken_[j].squaredNorm()) * taken_[j + 1];
  if (taken_.empty()) return step;
  const double share = taken_.back().dot(step) / taken_.back().squaredNorm();
  if (share < kLargestShare) step /= 1.0 - share;
  return step;
}

}  // namespace voussoir
