#include "lookup/report/scene_forces.h"

#include "core/error.h"
#include "core/solve/state_history.h"
#include "database/records/stored_bridge.h"

namespace voussoir {
namespace {

/// Of the intact bridge, which a database may lack.
SceneStates intact_states(const Database& database, const StatePlan& plan, QuasiStaticSolver& solver) {
  const auto row = database.find(Scene{});
  SceneStates states = row ? stored_states(database, *row, plan) : SceneStates(plan.size());
  if (!states[kBuilt]) states[kBuilt] = solver.solve(Scene{});
  return states;
}

}  // namespace

SceneForces scene_forces(const Database& database, std::size_t row, std::size_t state) {
  const Scene scene = database.key(row).scene;
  if (const Solution stored = database.solution(row, state); !stands(stored))
    throw Failure(
        fmt::format("{}: scene {} is {} as {}, expected one that stands: its field is no equilibrium",
                    database.path().string(), to_string(scene, database.layout()), to_string(stored.outcome),
                    database.states()[state]));
  const Model bridge = bridge_of(database);
  const StatePlan plan = plan_states(database.states(), bridge, description_of(database));
  QuasiStaticSolver solver(bridge);
  const Coefficients coefficients(solver.system(), bridge.parameters);
  const StateEquations equations{solver.system(), coefficients, plan,
                                 [&solver](const StageTask& task) { return solver.solve(task); }, 0.0};
  const auto planned = std::ranges::find(plan, database.states()[state], &PlannedState::name);
  const auto history =
      history_of_state(equations, scene, static_cast<std::size_t>(planned - plan.begin()),
                       stored_states(database, row, plan), intact_states(database, plan, solver));
  if (!history)
    throw Failure(fmt::format("{}: a state before {} of scene {} does not stand", database.path().string(),
                              database.states()[state], to_string(scene, database.layout())));
  const SolvedStep& last = history->back();
  SceneForces forces{scene,
                     triangle_stresses(last.equations, bridge.parameters, last.displacement),
                     joint_forces(last.equations, bridge.parameters, last.displacement),
                     {}};
  forces.thrust = thrust_lines(bridge, forces.joints);
  return forces;
}

}  // namespace voussoir
