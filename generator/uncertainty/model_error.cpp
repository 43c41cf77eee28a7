#include "generator/uncertainty/model_error.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/solve/state_name.h"
#include "core/structure/block_layout.h"
#include "generator/scenes/scene_list.h"
#include "generator/scenes/state_solving.h"
#include "generator/uncertainty/error_fit.h"

namespace voussoir {
namespace {

constexpr std::size_t kMostProbes = 24;  // singles: under 2 % of the time of a whole database
constexpr double kFinestPieces = 20000;  // triangles; larger bridges are not refined further

using Settlements = std::vector<Eigen::VectorXd>;  // of each state; empty where the scene does not stand

Settlements settlements_of(const SceneGroup& group, const StatePlan& plan, const Model& bridge) {
  Settlements settlements;
  for (const std::size_t state : kept_states(plan)) {
    const Solution& solution = *group.states[state];
    settlements.push_back(stands(solution) ? readings_at(bridge.control_points, solution.displacement)
                                           : Eigen::VectorXd());
  }
  return settlements;
}

/// One that finds equilibria only, unless the intact bridge stands by what it has slipped in motion.
StageSolver probe_solver(const ErrorProbes& probes, const Model& bridge) {
  const StageTask intact{.stage = {.scene = {}}};
  StageSolver of_equilibria = probes.solver.make_equilibrium_solver(bridge);
  if (stands(of_equilibria({&intact, 1}).front())) return of_equilibria;
  StageSolver of_all = probes.solver.make_solver(bridge, probes.solver.settings(bridge));
  return stands(of_all({&intact, 1}).front()) ? of_all : of_equilibria;
}

/// Places, among the kept states, of those in which the intact bridge stands.
std::vector<std::size_t> compared_states(const ErrorProbes& probes) {
  std::vector<std::size_t> places(kept_states(probes.states).size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  if (!probes.intact_stands.empty())
    std::erase_if(places, [&](std::size_t place) { return !probes.intact_stands[place]; });
  return places;
}

/// Control displacements in the states of these names of the intact bridge and the singles, on one mesh.
std::vector<Settlements> solve_probes(const ErrorProbes& probes, const Model& bridge,
                                      const BridgeDescription& description,
                                      const std::vector<std::string>& names,
                                      const std::vector<Scene>& singles) {
  const StatePlan plan = plan_states(names, bridge, description);
  const StateSolving solving(bridge, plan);
  std::vector<SceneGroup> groups = {{.solved = {}, .states = {}, .image = {}}};
  for (const Scene& single : singles) groups.push_back({.solved = single, .states = {}, .image = {}});
  solving.solve_from_intact(probe_solver(probes, bridge), groups);
  std::vector<Settlements> result;
  for (const SceneGroup& group : groups) result.push_back(settlements_of(group, plan, bridge));
  return result;
}

/// Singles of wall blocks, evenly spread.
std::vector<Scene> probed_singles(const BlockLayout& layout) {
  std::vector<Scene> singles;
  for (std::size_t b = 0; b < layout.size(); ++b)
    if (layout.blocks[b].role == BlockRole::wall)
      singles.push_back(Scene{{BlockId{static_cast<std::int32_t>(b)}}});
  return evenly_chosen(singles, kMostProbes);
}

ModelError error_of_state(const std::vector<Settlements>& coarse, const std::vector<Settlements>& fine,
                          std::size_t state) {
  const Eigen::VectorXd& intact = coarse.front()[state];
  const Eigen::VectorXd& fine_intact = fine.front()[state];
  if (intact.size() == 0 || fine_intact.size() == 0) return {};
  ErrorFit fit;
  for (std::size_t i = 1; i < coarse.size(); ++i) {
    if (coarse[i][state].size() == 0 || fine[i][state].size() == 0) continue;
    const Eigen::VectorXd signal = coarse[i][state] - intact;
    fit.add(signal, kErrorPerLevel * (fine[i][state] - fine_intact - signal));
  }
  const Eigen::Vector2d squares = fit.squares();
  const Eigen::VectorXd error = kErrorPerLevel * (fine_intact - intact).cwiseAbs();
  return {std::sqrt(squares[0]), std::sqrt(squares[1]), {error.begin(), error.end()}};
}

/// Of each kept state: how far the mesh puts it off.
std::vector<ModelError> errors_of_mesh(const ErrorProbes& probes, Progress& progress) {
  BridgeDescription finer = probes.description;
  ++finer.mesh.refinement;
  const std::vector<Scene> singles = probed_singles(probes.bridge.layout);
  const std::vector<std::size_t> kept = kept_states(probes.states), compared = compared_states(probes);
  std::vector<ModelError> errors(kept.size());
  if (compared.empty()) return errors;
  std::vector<std::string> names;
  for (const std::size_t place : compared) names.push_back(probes.states[kept[place]].name);
  progress.start(2, 0, "meshes for the model's error");
  const auto coarse = solve_probes(probes, probes.bridge, probes.description, names, singles);
  progress.advance(1);
  const auto fine = solve_probes(probes, make_model(finer), finer, names, singles);
  progress.advance(1);
  progress.finish();
  for (std::size_t state = 0; state < compared.size(); ++state)
    errors[compared[state]] = error_of_state(coarse, fine, state);
  return errors;
}

}  // namespace

ModelError with_sudden_release(ModelError error) {
  error.share = std::hypot(error.share, kShareOfSuddenRelease);
  error.common = std::hypot(error.common, kCommonOfSuddenRelease);
  return error;
}

std::vector<ModelError> estimate_model_errors(const ErrorProbes& probes, Progress& progress) {
  const std::vector<std::size_t> kept = kept_states(probes.states);
  std::vector<ModelError> errors(kept.size());
  if (!probes.solver.make_equilibrium_solver) return errors;
  if (4.0 * static_cast<double>(probes.bridge.mesh.triangles.size()) <= kFinestPieces)
    errors = errors_of_mesh(probes, progress);
  for (std::size_t i = 0; i < kept.size(); ++i)
    if (history_of(probes.states[kept[i]].name) == kLostState)
      errors[i] = with_sudden_release(std::move(errors[i]));
  return errors;
}

}  // namespace voussoir
