#pragma once
/// @file Adjoints: the transposed tangent of an equilibrium, solved for many right-hand sides.

#include <Eigen/Core>
#include <vector>

#include "core/statics/equilibrium.h"
#include "core/statics/lane_factorisation.h"

namespace voussoir {

/// A row a displacement component, a column a reading: what is done at a component is done for all readings.
using ComponentRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

class TransposedSolver {
 public:
  /// The system outlives the solver.
  explicit TransposedSolver(const EquilibriumSystem& system);

  /// Replaces right-hand sides, at all displacement components (a column each), by solutions of K^T z = b
  /// with the tangent K at this displacement; zero at held components. False if K is singular.
  bool solve(const StageEquations& equations, const Field& displacement, ComponentRows& right_hand_sides);

 private:
  const EquilibriumSystem& system_;
  std::vector<int> transposed_slot_;  ///< of each entry of the pattern: the place of its mirror entry
  SharedFactorisation linear_;
  std::vector<double> tangent_;
  Cells<double> transposed_;
  LaneVector right_;
};

}  // namespace voussoir
