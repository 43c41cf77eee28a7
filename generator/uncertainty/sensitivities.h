#pragma once
/// @file Sensitivities of the intact bridge and the singles to what is uncertain of the bridge, for a
/// database.

#include "core/solve/state_plan.h"
#include "database/records/sensitivities.h"
#include "generator/running/progress.h"
#include "generator/scenes/known_records.h"
#include "generator/scenes/solvers.h"
#include "generator/uncertainty/sensitivity_basis.h"

namespace voussoir {

/// What is found for which bridge with what.
struct SensitivityStudy {
  const BridgeDescription& description;
  const Model& bridge;      ///< of that description, the nominal variant
  const StatePlan& states;  ///< those that are kept are looked at
  const SolverChoice& solver;
  const std::string& settings;  ///< of the solver
  int threads = 0;
};

/// Sensitivities of the intact bridge and of those of the scenes that lack one block, where they stand; in
/// `known` are their states as far as they have been solved. Nothing if nothing is uncertain or the intact
/// bridge does not stand.
///
/// A state of which the stored field is in equilibrium after one implicit step, too, has the derivatives of
/// this step; of others the loss is solved again in all its steps.
std::optional<Sensitivities> find_sensitivities(const SensitivityStudy& study,
                                                const std::vector<Scene>& scenes, const KnownRecords& known,
                                                Progress& progress);

}  // namespace voussoir
