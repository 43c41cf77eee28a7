#pragma once
/// @file Carrying out a plan: solving its tasks on several threads and keeping their records.

#include "generator/running/progress.h"
#include "generator/scenes/build_plan.h"
#include "generator/scenes/known_records.h"

namespace voussoir {

/// What a plan is carried out with.
struct PlanRun {
  std::span<const Model> bridges;  ///< the variants
  const SolverChoice& solver;
  const std::string& settings;  ///< that the database states
  PlanRules rules;
  const StatePlan& states;
  KeepField fields;
  int most_starting;  ///< scenes with at most so many missing blocks keep their fields to start others
  int threads = 0;    ///< 0: one for each core
  Progress& progress;
};

/// Appends the records of all tasks to the journal of what is known.
void run_plan(BuildPlan plan, const PlanRun& run, KnownRecords& known);

}  // namespace voussoir
