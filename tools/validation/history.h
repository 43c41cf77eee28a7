#pragma once
/// @file Histories followed stage by stage with Newton's method alone: what the states of a database
/// (core/solve/state_plan.h), which are found scene by scene from stored fields, are compared with.

#include <string>
#include <vector>

#include "core/statics/quasi_static_solver.h"

namespace voussoir::validation {

/// A stage and what it is called.
struct NamedStage {
  std::string name;
  Stage stage;
  int steps = 1;  ///< as in StageTask
};

/// Stages that follow each other, each from the state that the one before leaves.
struct History {
  std::string name;
  std::vector<NamedStage> stages;  ///< at least one
};

/// Gravity on the bridge without the scene's blocks: the paper's order.
History built(const Scene& scene);

/// Gravity on the intact bridge, then the blocks go and what they carried is shared out anew, in
/// kStepsOfLoss.
History lost(const Scene& scene);

/// The history with one more stage, which has this load on the blocks that the last one has.
History followed_by(History history, const std::string& load_name, const Field& load);

/// The solution at the end of every stage, in order. A stage starts from the place and the memory of the one
/// before; after a stage that does not stand there are no more.
std::vector<Solution> solve_history(QuasiStaticSolver& solver, const History& history,
                                    const Parameters* parameters = nullptr);

}  // namespace voussoir::validation
