#pragma once
/// @file Errors of signals as a share of them.

#include <Eigen/Core>

namespace voussoir {

/// Least squares of e_i^2 = share^2 s_i^2 + common^2 rms(s)^2 over many signals s and their errors e, every
/// signal counting alike. NaN: the signal has no such point.
class ErrorFit {
 public:
  void add(const Eigen::VectorXd& signal, const Eigen::VectorXd& error);

  /// share^2 and common^2. Where one would be negative it is zero, and the other is fitted alone, as common^2
  /// is where signals do not tell them apart; zero without signals.
  Eigen::Vector2d squares() const;

 private:
  Eigen::Matrix2d normal_ = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right_ = Eigen::Vector2d::Zero();
};

}  // namespace voussoir
