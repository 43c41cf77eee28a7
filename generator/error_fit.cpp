#include "generator/error_fit.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace voussoir {
namespace {

/// The square of the sine between the two terms, at least, by which signals tell them apart. Those of one
/// point are the same.
constexpr double kApart = 1e-12;

}  // namespace

void ErrorFit::add(const Eigen::VectorXd& signal, const Eigen::VectorXd& error) {
  double sum = 0.0;
  Eigen::Index count = 0;
  for (const double s : signal)
    if (!std::isnan(s)) {
      sum += s * s;
      ++count;
    }
  const double mean_square = count > 0 ? sum / static_cast<double>(count) : 0.0;
  if (mean_square == 0.0) return;
  for (Eigen::Index i = 0; i < signal.size(); ++i) {
    if (std::isnan(signal[i]) || std::isnan(error[i])) continue;
    const Eigen::Vector2d terms(signal[i] * signal[i] / mean_square, 1.0);
    normal_ += terms * terms.transpose();
    right_ += terms * (error[i] * error[i] / mean_square);
  }
}

Eigen::Vector2d ErrorFit::squares() const {
  if (normal_(1, 1) == 0.0) return Eigen::Vector2d::Zero();
  const bool are_apart = normal_.determinant() > kApart * normal_(0, 0) * normal_(1, 1);
  const Eigen::Vector2d both =
      are_apart ? Eigen::Vector2d(normal_.inverse() * right_) : Eigen::Vector2d(-1.0, 0.0);
  if (both.minCoeff() >= 0.0) return both;
  const Eigen::Index kept = both[0] < 0.0 ? 1 : 0;
  Eigen::Vector2d one = Eigen::Vector2d::Zero();
  one[kept] = std::max(0.0, right_[kept] / normal_(kept, kept));
  return one;
}

}  // namespace voussoir
