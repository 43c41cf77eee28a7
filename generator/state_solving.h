#pragma once
/// @file Solving the states of scenes one after the other.
///
/// Every state is found from stored fields only: what the joints remember of a state follows from its field
/// in storage precision and the memory before it. So a record is the same whatever was computed before it,
/// interrupted or taken over.

#include "core/statics/equilibrium.h"
#include "generator/scene_solving.h"
#include "generator/start_field.h"
#include "generator/state_plan.h"

namespace voussoir {

/// What is known or found of a scene, for each state of the plan.
using SceneStates = std::vector<std::optional<Solution>>;

/// A scene and, if it is wanted, its mirror image, which are solved together.
struct SceneGroup {
  Scene solved;
  SceneStates states;     ///< of the scene; what is there already is taken as it is
  bool needs_all = true;  ///< false: only those states of the scene that the image follows from
  std::optional<Scene> image;
  SceneStates image_states{};
};

/// The equations of a variant, and what the joints remember.
class StateSolving {
 public:
  /// The bridge and the plan outlive it.
  StateSolving(const Model& bridge, const StatePlan& plan)
      : bridge_(bridge), plan_(plan), system_(bridge), coefficients_(system_, bridge.parameters) {}

  /// Solves all states of the groups, state after state, many scenes side by side. Where `warm_starts` is
  /// false a search starts from rest, or from the state before.
  ///
  /// `lost` of the intact bridge is its `built`. A scene that does not stand as built and of which no
  /// equilibrium as lost is found has the state that it has as built, and so it has if the intact bridge does
  /// not stand. A load that acts on a scene which does not stand leaves its state as it is.
  void solve(const SceneSolver& solver, const StartingFields& starts, bool warm_starts,
             std::span<SceneGroup> groups) const;

  /// What the joints remember of the intact bridge as built, given its field; nothing for null.
  std::vector<JointMemory> memory_of_intact(const Field* intact) const;

  /// What the joints remember when a state of a scene begins. Precondition: the states before it are there,
  /// which then keep what is remembered of them.
  std::vector<JointMemory> memory_before(const Scene& scene, std::size_t state, SceneStates& states,
                                         const std::vector<JointMemory>& of_intact) const;

  /// The equations of a state that begins with this memory.
  StageEquations equations(const Scene& scene, std::size_t state, std::vector<JointMemory> memory) const;

 private:
  struct Search;
  /// What all scenes that are solved side by side share.
  struct Shared {
    const StartingFields& starts;
    bool warm_starts;
    std::vector<JointMemory> of_intact;
  };
  std::optional<Solution> without_search(const Scene& scene, std::size_t state, const SceneStates& states,
                                         const StartingFields& starts) const;
  Search search_for(const Scene& scene, std::size_t state, SceneStates& states, const Shared& shared) const;
  std::vector<Search> searches_of(std::size_t state, std::span<SceneGroup> groups,
                                  const Shared& shared) const;
  void take(std::size_t state, Solution&& solution, SceneStates& states) const;

  const Model& bridge_;
  const StatePlan& plan_;
  EquilibriumSystem system_;
  Coefficients coefficients_;
};

}  // namespace voussoir
