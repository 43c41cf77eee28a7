#pragma once
/// @file Newton's search for the equilibrium of one scene, as a machine that asks for one linear solution
/// after another, so that several searches can share their factorisations' arithmetic.

#include <array>
#include <vector>

#include "core/statics/broyden.h"
#include "core/statics/equilibrium.h"
#include "core/statics/quasi_static_solver.h"
#include "core/statics/search_phase.h"

namespace voussoir {

/// One scene's search. After construction, and after every `advance` that does not finish it, the target
/// holds the matrix and `unbalanced` the right-hand side of the next linear system. The matrix is the
/// tangent, or if factors may be kept (Skips) that of an earlier place: then Broyden's secants correct the
/// steps, until one makes too little progress.
class NewtonSearch {
 public:
  /// `start` may be null: the search then begins at rest. `patient_phase`: with that. `has_matrix`:
  /// the target holds a matrix of a search that has just ended at `start`, which may serve this one, too.
  /// System, coefficients and settings outlive the search.
  NewtonSearch(StageEquations equations, const QuasiStaticSettings& settings, const Field* start,
               TangentTarget tangent, bool patient_phase = false, bool has_matrix = false);

  bool finished() const { return phase_ == SearchPhase::done; }
  /// Is the matrix in the target another one than that of the last linear system?
  bool has_new_matrix() const { return matrix_is_new_; }
  const Field& unbalanced() const { return unbalanced_; }
  /// Largest component of the first step [m]: how far the tangent there says that it is.
  double first_step() const { return first_step_; }

  /// Takes the linear system's answer: the displacement step at the unknowns, or that the matrix is singular.
  void advance(bool regular, const Eigen::VectorXd& step);

  /// Precondition: finished.
  Solution solution() const;

 private:
  void begin(SearchPhase phase, const Field& start, double bonding);
  void begin_from_rest(SearchPhase phase);
  void begin_next_phase();
  void go_on_boldly(SearchPhase phase);  // from where the search is
  void take_step(const Eigen::VectorXd& step);
  void try_step_with_old_matrix(const Eigen::VectorXd& step);
  void move(const Field& from, double factor, const Eigen::VectorXd& step);
  void note_step(double length);
  void note_progress();
  void evaluate();
  void evaluate_forces();
  bool may_keep_matrix() const;
  void note_norm();
  bool within_bounds(bool regular, const Eigen::VectorXd& step) const;
  bool exhausted() const;
  bool in_equilibrium() const;
  bool fallen() const;
  double falling_displacement() const;
  double residual() const;
  double largest_displacement() const { return displacement_.cwiseAbs().maxCoeff(); }
  Field at_rest() const { return Field::Zero(2, displacement_.cols()); }

  static constexpr std::size_t kRecent = 5;

  const EquilibriumSystem& system() const { return *equations_.system; }

  StageEquations equations_;
  const QuasiStaticSettings* settings_;
  TangentTarget tangent_;
  SearchPhase phase_ = SearchPhase::done;
  Field displacement_;
  Field unbalanced_;      ///< at `displacement_` [N]
  double bonding_ = 0.0;  ///< share of bonded joints in the tangent
  bool matrix_is_new_ = true;
  BroydenSecants secants_;  ///< of the steps with the matrix in the target
  double last_step_ = 0.0;  ///< largest component [m]
  std::array<double, kRecent>
      recent_{};             ///< the last norms of `unbalanced_`: a step may rise to the worst of them
  double start_sag_ = 0.0;   ///< largest displacement of the start [m]
  double bonded_sag_ = 0.0;  ///< largest displacement after the bonded first step from rest [m]; 0 before
  double norm_ = 0.0;        ///< of `unbalanced_`, in units of the largest load
  double first_norm_ = 0.0;  ///< after the start's first step
  double first_step_ = 0.0;  ///< of the phase [m]; 0 before
  double least_norm_ = 0.0;  ///< that counted as progress
  int stalled_ = 0;          ///< steps since
  int steps_ = 0;            ///< since the start
  Field before_bold_;        ///< where a bold phase began
  int phase_iterations_ = 0;
  int iterations_ = 0;  ///< linear systems in all phases
};

}  // namespace voussoir
