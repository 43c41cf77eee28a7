#pragma once
/// @file How a stage is reached: the implicit steps of one task, each a search of Newton's.

#include <optional>

#include "core/statics/equilibrium.h"
#include "core/statics/newton_search.h"
#include "core/statics/quasi_static_solver.h"

namespace voussoir {

/// One task on its way. A stage with nothing before it is one search, wherever it ends. In a later stage,
/// what holds the structure where the stage before ended is let go step by step, and each step shall end near
/// where the structure is going. Where no equilibrium is near, it jumps: it is followed against drag that is
/// let go more and more, while its joints remember what they slip on the way, until it rests or blocks have
/// moved away. Structures with mortar are not followed: a file could not keep what their joints remember.
///
/// The target gets the matrices of the task's searches one after another. Everything that is given outlives
/// the steps, which stay where they are made.
class StageSteps {
 public:
  StageSteps(const EquilibriumSystem& system, const Coefficients& nominal,
             const QuasiStaticSettings& settings, const StageTask& task, TangentTarget tangent);
  StageSteps(const StageSteps&) = delete;
  StageSteps& operator=(const StageSteps&) = delete;

  /// The search that is under way.
  const NewtonSearch& search() const { return *search_; }

  /// Takes the answer of the search's linear system; true if the task is done.
  bool advance(bool regular, const Eigen::VectorXd& step);

  /// Precondition: the task is done.
  Solution&& take() { return std::move(reached_); }

 private:
  void begin_step(bool has_matrix);
  bool accept(Solution&& found);
  bool give_up(const Solution& found);
  bool begin_jump(const Solution& found);
  bool follow_jump(Solution&& found);
  Field move_to(Solution&& found, bool keeps_last);
  bool is_near(const Field& found) const;
  bool falls();
  bool end();

  const Coefficients& coefficients() const { return own_ ? *own_ : nominal_; }

  const EquilibriumSystem& system_;
  const Coefficients& nominal_;
  const StageTask& task_;
  TangentTarget tangent_;
  bool follows_;                            ///< step by step; otherwise a step ends wherever it does
  QuasiStaticSettings settings_;            ///< those given, as the task changes them
  double tolerance_;                        ///< of the last step
  std::optional<Coefficients> own_;         ///< of a variant or stage with joints unlike the solver's model
  Solution reached_;                        ///< at the end of the last step
  std::vector<JointMemory> memory_before_;  ///< what the last step began with
  double sag_ = 0.0;                        ///< largest displacement where the stage before ended [m]
  double loaded_sag_ = 0.0;    ///< how far the first tangent says that the load moves something [m]
  int left_;                   ///< steps, with the one under way
  Field start_;                ///< of its search; empty: from rest
  Field held_;                 ///< forces that are still held back at its end [N]
  double reach_ = 0.0;         ///< of the drag [m]; 0: there is none
  int drags_ = 0;              ///< steps against drag so far; some: it has jumped
  double largest_load_ = 0.0;  ///< as in StageEquations
  std::optional<NewtonSearch> search_;
};

}  // namespace voussoir
