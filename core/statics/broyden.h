#pragma once
/// @file Broyden's method: what steps taken with an old factorisation tell of the matrix as it is now.

#include <Eigen/Core>
#include <vector>

namespace voussoir {

/// Secants of full steps towards the root of r, all from systems with one matrix K, kept while -dr/du drifts
/// away from it: every step changes the matrix by the least that explains what it did to r (Broyden's "good"
/// update; C. T. Kelley, Iterative Methods for Linear and Nonlinear Equations, SIAM 1995, section 7.3).
class BroydenSecants {
 public:
  /// The step from here, given K^-1 r here. That itself if no step has been taken with K.
  Eigen::VectorXd step(const Eigen::VectorXd& solution) const;

  /// Takes in the step that has just been taken with K, as `step` gave it.
  void add(Eigen::VectorXd taken) { taken_.push_back(std::move(taken)); }

  void clear() { taken_.clear(); }
  std::size_t size() const { return taken_.size(); }

 private:
  std::vector<Eigen::VectorXd> taken_;
};

}  // namespace voussoir
