#pragma once
/// @file How readings at the end of a history change with the uncertain parameters: adjoint sensitivities.
///
/// A history is a chain of implicit steps k. With the displacement u, the joints' memory m and the parameters
/// theta, each ends where
///     r(u_k, m_(k-1), theta) - h_k r(u_(k-1), m_(k-1), theta) = 0,     m_k = M(u_k, m_(k-1), theta),
/// r being the unbalanced forces of its stage and h_k the share of them that is still held back. Of a reading
/// p . u_K the adjoint goes from the last step to the first:
///     K(u_k)^T lambda = b,     dp/dtheta += lambda . d(r_k - h_k r_(k-1))/dtheta + g . dM/dtheta
/// where K = -dr/du; b and g are the derivatives of the reading by u_k and m_k. So one factorisation a step
/// serves all readings and all parameters.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <optional>
#include <vector>

#include "core/statics/equilibrium.h"
#include "core/statics/solution.h"
#include "core/statics/transposed_solver.h"
#include "core/structure/uncertain_parameters.h"

namespace voussoir {

/// One implicit step of a history as it was solved.
struct SolvedStep {
  StageEquations equations;  ///< of the stage, with its whole load and the memory that the step begins with
  Field displacement;        ///< at its end; no NaN
  Field place;               ///< where the step before ended; no NaN
  double held_share = 0.0;   ///< of the forces that are unbalanced there: these are still held back
  bool has_slipped =
      false;  ///< what the step begins with is given (Solution::slipped): it depends on nothing
};

using SolvedHistory = std::vector<SolvedStep>;

/// Adds the steps of a stage that stands. `steps`: as in StageTask; if several, the solution has them. Of a
/// stage that begins with what has slipped there is one.
/// System and coefficients outlive the history.
void append_stage(const EquilibriumSystem& system, const Coefficients& coefficients, const Stage& stage,
                  const Solution& solution, int steps, SolvedHistory& history);

/// What each point reads, as weights of the displacement components (2 node + axis): components x points.
Eigen::MatrixXd reading_columns(const Structure& structure, const std::vector<ControlPoint>& points);

/// Not thread-safe: one a thread.
class SensitivitySolver {
 public:
  /// All outlive the solver. The system's joints are integrated exactly (JointRule::exact).
  SensitivitySolver(const EquilibriumSystem& system, const UncertainParameters& uncertain);

  /// Derivatives of readings at the history's end: readings x parameters, in the order of
  /// UncertainParameters::all(), each per standard deviation, at the parameters that the history was solved
  /// with. `readings`: a column a reading, of the displacement components. Joints that open, close, slip or
  /// stick just there have one-sided derivatives; these are those of one side. Nothing if a tangent is
  /// singular.
  std::optional<Eigen::MatrixXd> solve(const SolvedHistory& history, const Eigen::MatrixXd& readings);

 private:
  struct Adjoint;
  bool step_back(const SolvedStep& step, bool is_first, Adjoint& adjoint);

  const EquilibriumSystem& system_;
  const UncertainParameters& uncertain_;
  Eigen::SparseMatrix<double> movements_;  ///< components x parameters of an epoch, per standard deviation
  TransposedSolver transposed_;
};

}  // namespace voussoir
