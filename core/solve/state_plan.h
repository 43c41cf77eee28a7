#pragma once
/// @file Which states are solved of every scene, in which order, and which of them a database keeps.

#include <optional>
#include <string>
#include <vector>

#include "core/statics/solution.h"
#include "core/structure/model.h"

namespace voussoir {

/// The names of a database's states, first each history's own, then the stages of load cases after each.
/// `histories`: "built", "lost" or both, separated by ','. `loads`: "all", "none" or names of load cases of
/// the bridge, separated by ','. Throws InputError for other words, naming the option.
std::vector<std::string> state_names(const std::string& histories, const std::string& loads,
                                     const std::vector<LoadDescription>& bridge_loads);

/// The number of the state `built` in every plan.
inline constexpr std::size_t kBuilt = 0;

/// Implicit steps in which the state `lost` of a single lets go what the blocks carried. More matter where a
/// joint slips on the way and stops (docs/numerics.md): of the reference bridge's wall singles 14 of 193 are
/// off by 1 to 5 % of the signal in one step, 6 in four, none in sixteen.
inline constexpr int kStepsOfLoss = 16;

/// How a state of any scene comes about.
struct PlannedState {
  std::string name;  ///< as in a database
  /// The state whose end it starts from. Nothing for `built`, which is the first stage. That of `lost` is
  /// `built` of the intact bridge; those of loads are of the scene itself.
  std::optional<std::size_t> before{};
  bool is_load = false;
  Field load{};         ///< [N] on the nodes; empty for histories' own states
  bool mirrors = true;  ///< the state of a scene's mirror image is the mirror image of its state
  bool kept = true;     ///< in the database

  /// Is it a history's own state in which blocks go?
  bool is_loss() const { return before && !is_load; }
};

/// Precondition of all that takes one: it comes from plan_states.
using StatePlan = std::vector<PlannedState>;

/// What is known or found of a scene, for each state of the plan.
using SceneStates = std::vector<std::optional<Solution>>;

/// The states of these names, as state_names gives them or a database states them. `built`, from which all
/// others are found, comes first even if it is not kept. Throws InputError for a name that is none, an order
/// that cannot be, or a load case that the description does not have.
StatePlan plan_states(const std::vector<std::string>& names, const Structure& bridge,
                      const BridgeDescription& description);

/// The number of `lost`, if it is solved.
std::optional<std::size_t> place_of_lost(const StatePlan& plan);

/// Are there loads that differ from their mirror images?
bool has_one_sided_loads(const StatePlan& plan);

/// The numbers of the states that are kept.
std::vector<std::size_t> kept_states(const StatePlan& plan);

}  // namespace voussoir
