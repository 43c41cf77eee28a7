#pragma once
/// @file Checks of stored scenes.

#include <span>

#include "database/records/database.h"
#include "generator/scenes/state_solving.h"

namespace voussoir {

/// What the checks of a scene need to know of its database and its variant.
struct CheckedVariant {
  const Database& database;
  const Model& bridge;            ///< bridge_of(database), the variant
  const StatePlan& plan;          ///< of the database's states
  const StateSolving& equations;  ///< of that bridge and that plan
  SearchBasis basis;              ///< of all that any scene as lost starts from
  double most_unbalance = 0.0;    ///< most_stored_unbalance(bridge)
  PlanRules rules{};  ///< by which it was built: mirror images that were used are equal bit by bit
};

struct SceneCheck {
  std::vector<std::string> problems;
  std::size_t fields = 0;  ///< that were checked
  bool mirror_compared = false;
  double unbalance = 0.0;  ///< of a standing scene's stored fields, the largest
};

/// How far from equilibrium the stored field of a standing scene can be [largest unbalanced nodal force over
/// largest nodal weight] in a database built with these settings. From Newton's method: the solver's own
/// limit, and half a storage step at every node against the stiffness of the bridge with all joints closed
/// (the largest sum of absolute values in a row of the tangent). From a motion: what is taken for rest.
double most_stored_unbalance(const Model& bridge, std::string_view settings);

/// One check a row, in the rows' order. `solver` is the variant's: where blocks went in many steps, these are
/// solved again, several scenes side by side. Never throws for what is wrong with the scenes' data.
std::vector<SceneCheck> check_scenes(const CheckedVariant& checked, std::span<const std::size_t> rows,
                                     const StageSolver& solver);

}  // namespace voussoir
