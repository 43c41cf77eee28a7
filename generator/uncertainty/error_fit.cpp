#include "generator/uncertainty/error_fit.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/median.h"

namespace voussoir {
namespace {

/// The square of the sine between the two terms, at least, by which signals tell them apart. Those of one
/// point are the same.
constexpr double kApart = 1e-12;

/// Signals below this share of the median one (root mean squares) do not count. What a block beside a held
/// end shows is rounding; the errors of others' sizes that are left there, in shares of that, are anything,
/// and would be those of all signals. A block whose loss shows as little, no readings show.
constexpr double kLeastSignal = 0.05;

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
  if (mean_square > 0.0) signals_.push_back({signal, error, mean_square});
}

Eigen::Vector2d ErrorFit::squares() const {
  if (signals_.empty()) return Eigen::Vector2d::Zero();
  std::vector<double> sizes;
  for (const Signal& signal : signals_) sizes.push_back(signal.mean_square);
  const double middle = median(sizes);
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  for (const auto& [values, errors, mean_square] : signals_) {
    if (mean_square < kLeastSignal * kLeastSignal * middle) continue;
    for (Eigen::Index i = 0; i < values.size(); ++i) {
      if (std::isnan(values[i]) || std::isnan(errors[i])) continue;
      const Eigen::Vector2d terms(values[i] * values[i] / mean_square, 1.0);
      normal += terms * terms.transpose();
      right += terms * (errors[i] * errors[i] / mean_square);
    }
  }
  if (normal(1, 1) == 0.0) return Eigen::Vector2d::Zero();
  const bool are_apart = normal.determinant() > kApart * normal(0, 0) * normal(1, 1);
  const Eigen::Vector2d both =
      are_apart ? Eigen::Vector2d(normal.inverse() * right) : Eigen::Vector2d(-1.0, 0.0);
  if (both.minCoeff() >= 0.0) return both;
  const Eigen::Index kept = both[0] < 0.0 ? 1 : 0;
  Eigen::Vector2d one = Eigen::Vector2d::Zero();
  one[kept] = std::max(0.0, right[kept] / normal(kept, kept));
  return one;
}

}  // namespace voussoir
