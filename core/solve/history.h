#pragma once
/// @file Histories: stages that follow each other, each from the state that the one before leaves.

#include <string>
#include <vector>

#include "core/statics/quasi_static_solver.h"

namespace voussoir {

struct NamedStage {
  std::string name;
  Stage stage;
  int steps = 1;  ///< as in StageTask
};

struct History {
  std::string name;
  std::vector<NamedStage> stages;  ///< at least one
};

/// Gravity on the bridge without the scene's blocks: the paper's order.
History built(const Scene& scene);

/// Gravity on the intact bridge, then the blocks go and what they carried is shared out anew.
History lost(const Scene& scene);

/// Steps in which `lost` lets go what the blocks carried. More matter where a joint slips on the way and
/// stops (docs/numerics.md): of the reference bridge's wall singles 14 of 193 are off by 1 to 5 % of the
/// signal in one step, 6 in four, none in sixteen.
inline constexpr int kStepsOfLoss = 16;

/// The history with one more stage, which has this load on the blocks that the last one has.
History followed_by(History history, const std::string& load_name, const Field& load);

/// The solution at the end of every stage, in order. A stage starts from the place and the memory of the one
/// before; after a stage that does not stand there are no more.
std::vector<Solution> solve_history(QuasiStaticSolver& solver, const History& history,
                                    const Parameters* parameters = nullptr);

}  // namespace voussoir
