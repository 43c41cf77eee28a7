#pragma once
/// @file Scenes of a bridge as build-database solves them when no option is given, on one thread.

#include <span>
#include <vector>

#include "generator/scenes/state_solving.h"

namespace voussoir {

class DefaultBuild {
 public:
  /// The model is that of the description, and outlives it.
  DefaultBuild(const BridgeDescription& description, const Model& model);

  /// The intact bridge as built, from which all later scenes start.
  Solution solve_intact();

  /// Scenes as built, several side by side, in their order.
  std::vector<Solution> solve(std::span<const Scene> scenes) const;

 private:
  StatePlan plan_;
  PlanRules rules_;
  StageSolver solver_;
  StateSolving states_;
  SearchBasis basis_;
};

}  // namespace voussoir
