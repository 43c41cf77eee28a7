#include "tools/validation/history.h"

#include "core/solve/state_plan.h"

namespace voussoir::validation {

History built(const Scene& scene) {
  return {"built", {{"built", {.scene = scene}}}};
}

History lost(const Scene& scene) {
  return {"lost", {{"built", {}}, {"lost", {.scene = scene}, kStepsOfLoss}}};
}

History followed_by(History history, const std::string& load_name, const Field& load) {
  NamedStage next{load_name, history.stages.back().stage};
  next.stage.load = next.stage.load.size() > 0 ? Field(next.stage.load + load) : load;
  history.stages.push_back(std::move(next));
  return history;
}

std::vector<Solution> solve_history(QuasiStaticSolver& solver, const History& history,
                                    const Parameters* parameters) {
  std::vector<Solution> solutions;
  solutions.reserve(history.stages.size());  // stages point to the ones before
  for (const NamedStage& next : history.stages) {
    const Solution* before = solutions.empty() ? nullptr : &solutions.back();
    if (before != nullptr && before->outcome != Outcome::standing) break;
    solutions.push_back(solver.solve(StageTask{.stage = next.stage,
                                               .start = before != nullptr ? &before->displacement : nullptr,
                                               .before = before,
                                               .parameters = parameters,
                                               .steps = next.steps}));
  }
  return solutions;
}

}  // namespace voussoir::validation
