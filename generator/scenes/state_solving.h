#pragma once
/// @file Solving the states of scenes one after the other.
///
/// Every state is found from stored fields only. What the joints remember of a state follows from its field
/// in storage precision and the memory before it (before `built`, what has slipped in motion), and where
/// blocks went in many steps from solving these again. So a record is the same whatever was computed before
/// it, interrupted or taken over.

#include "core/solve/state_plan.h"
#include "core/statics/equilibrium.h"
#include "generator/scenes/build_plan.h"
#include "generator/scenes/composition.h"
#include "generator/scenes/proved_falls.h"
#include "generator/scenes/solvers.h"
#include "generator/scenes/start_field.h"
#include "generator/scenes/steps_of_loss.h"

namespace voussoir {

/// A scene and, if it is wanted, its mirror image, which are solved together.
struct SceneGroup {
  Scene solved;
  SceneStates states;     ///< of the scene; what is there already is taken as it is
  bool needs_all = true;  ///< false: only those states of the scene that the image follows from
  std::optional<Scene> image;
  SceneStates image_states{};
};

/// What searches for the states of a variant's scenes begin with: StateSolving::basis makes it.
struct SearchBasis {
  StartingFields starts;
  bool warm_starts = true;             ///< false: a search starts from rest, or from the state before
  bool collapse_fields = true;         ///< false: solutions that fall have no field (NaN)
  ProvedFalls falls;                   ///< what is known to fall without a search
  Composition composition;             ///< as built, of what needs no search
  std::vector<JointMemory> of_intact;  ///< what joints remember of the intact bridge as built
  StepsOfLoss steps;
};

/// The equations of a variant, and what the joints remember.
class StateSolving {
 public:
  /// The bridge and the plan outlive it.
  StateSolving(const Model& bridge, const StatePlan& plan)
      : bridge_(bridge), plan_(plan), system_(bridge), coefficients_(system_, bridge.parameters) {}

  /// Solves those of the singles that stand as lost among the starts again, in one step.
  SearchBasis basis(const StageSolver& solver, StartingFields starts, const PlanRules& rules) const;

  /// Solves all states of the groups, state after state, many scenes side by side. `basis` has the states of
  /// the groups' starting_scenes.
  ///
  /// `lost` of the intact bridge is its `built`. A scene that does not stand as built and of which no
  /// equilibrium as lost is found has the state that it has as built, and so it has if the intact bridge does
  /// not stand. A load that acts on a scene which does not stand leaves its state as it is.
  ///
  /// States of many steps come with what the joints remember of them.
  void solve(const StageSolver& solver, const SearchBasis& basis, std::span<SceneGroup> groups) const;

  /// The same without a basis: the first group is the intact bridge, from whose states the others' follow.
  /// What of them is known is not searched for again.
  void solve_from_intact(const StageSolver& solver, std::span<SceneGroup> groups) const;

  /// The states of scenes of which nothing is known, the intact bridge first.
  std::vector<SceneStates> states_from_intact(const StageSolver& solver,
                                              const std::vector<Scene>& scenes) const;

  /// What the joints remember when a state of a scene begins; of a stage of many steps, when its first step
  /// does. Precondition: the states before it are there, which then keep what is remembered of them.
  std::vector<JointMemory> memory_before(const Scene& scene, std::size_t state, SceneStates& states,
                                         const std::vector<JointMemory>& of_intact) const;

  /// The equations of a state that begins with this memory.
  StageEquations equations(const Scene& scene, std::size_t state, std::vector<JointMemory> memory) const;

 private:
  struct Search;
  /// What the joints remember of the intact bridge as built, given its field and what had slipped before.
  std::vector<JointMemory> memory_of_intact(const Field& displacement, const Eigen::Matrix2Xd& slipped) const;
  std::optional<Solution> without_search(const Scene& scene, std::size_t state, const SceneStates& states,
                                         const SearchBasis& basis) const;
  Search one_step_search(const Scene& scene, std::size_t state, SceneStates& states,
                         const SearchBasis& basis) const;
  Search search_for(const Scene& scene, std::size_t state, SceneStates& states,
                    const SearchBasis& basis) const;
  std::size_t history_of(std::size_t state) const;
  std::vector<Search> searches_of(std::size_t state, std::span<SceneGroup> groups,
                                  const SearchBasis& basis) const;
  bool lacks_memory(const SceneGroup& group, bool is_image, std::size_t loss, const SearchBasis& basis) const;
  void find_lacking_memory(const StageSolver& solver, std::size_t loss, std::span<SceneGroup> groups,
                           const SearchBasis& basis) const;
  void take(std::size_t state, Solution&& solution, const SearchBasis& basis, SceneStates& states) const;
  StepsOfLoss steps_of_loss(const StageSolver& solver, const SearchBasis& basis, std::size_t lost) const;

  const Model& bridge_;
  const StatePlan& plan_;
  EquilibriumSystem system_;
  Coefficients coefficients_;
};

}  // namespace voussoir
