#pragma once
/// @file Errors of signals as a share of them.

#include <Eigen/Core>
#include <vector>

namespace voussoir {

/// Least squares of e_i^2 = share^2 s_i^2 + common^2 rms(s)^2 over many signals s and their errors e, every
/// signal counting alike, but for those that are next to nothing (kLeastSignal). NaN: the signal has no such
/// point.
class ErrorFit {
 public:
  void add(const Eigen::VectorXd& signal, const Eigen::VectorXd& error);

  /// share^2 and common^2. Where one would be negative it is zero, and the other is fitted alone, as common^2
  /// is where signals do not tell them apart; zero without signals.
  Eigen::Vector2d squares() const;

 private:
  struct Signal {
    Eigen::VectorXd values, errors;
    double mean_square;  // not zero
  };
  std::vector<Signal> signals_;
};

}  // namespace voussoir
