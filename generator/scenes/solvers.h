#pragma once
/// @file The solvers as the generator sees them.

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/solve/settings.h"

namespace voussoir {

struct SolverChoice {
  /// "key = value" lines: everything that the solver's answers for this model depend on.
  std::function<std::string(const Model&)> settings;
  /// A solver of a variant with these settings, which `settings` gave for the nominal bridge; called for each
  /// thread.
  std::function<StageSolver(const Model&, const std::string& settings)> make_solver;
  /// One that finds equilibria only, quickly: for what is compared with others and not kept. May be empty: no
  /// model error is then estimated.
  std::function<StageSolver(const Model&)> make_equilibrium_solver{};
  /// One whose motions are loaded slowly: where friction leaves open what joints slide, it finds another
  /// answer. Given if the one before is.
  std::function<StageSolver(const Model&)> make_slow_solver{};
};

/// The program's own solvers (core/solve).
SolverChoice solver_with(const SolverSettings& settings);

/// The solver that acts as a database states it. Throws Failure if another version wrote the settings.
StageSolver stated_solver(const Model& model, const std::string& settings);
SolverChoice quasi_static(const DynamicSettings& motion = {});
/// The same for databases without fields of collapses (core/solve/outcomes_only.h).
SolverChoice for_outcomes(const DynamicSettings& motion = {});
/// Of these two the one for databases with fields of collapses or without.
SolverChoice quasi_static_with(bool collapse_fields, const DynamicSettings& motion = {});
/// Are fields of collapses kept if no option says? Where the description wants them and motion can follow the
/// joints as they are.
bool keeps_collapse_fields(const BridgeDescription& description, const Model& bridge,
                           const DynamicSettings& motion = {});
SolverChoice dynamic(const DynamicSettings& motion = {});

}  // namespace voussoir
