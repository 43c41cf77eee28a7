#pragma once
/// @file The settings that a database states: the solver's and the generator's own.

#include <string>

#include "generator/scenes/build_plan.h"
#include "generator/scenes/solvers.h"

namespace voussoir {

/// "key = value" lines: everything beside the bridge that a database's content depends on.
std::string build_settings(const SolverChoice& solver, const Model& bridge, const PlanRules& rules);

/// The rules that build_settings states.
PlanRules rules_in(const std::string& settings);

}  // namespace voussoir
