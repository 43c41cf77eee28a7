#include "tools/trials/sampled_truth.h"

#include <cmath>
#include <set>

#include "core/error.h"
#include "core/geometry/polygon.h"
#include "core/random.h"
#include "core/solve/combined_solver.h"
#include "core/solve/state_name.h"
#include "core/solve/state_plan.h"
#include "core/structure/rigid_movement.h"
#include "core/structure/unevenness.h"
#include "core/text.h"
#include "core/threads.h"
#include "generator/build.h"
#include "generator/scenes/variants.h"

namespace voussoir {
namespace {

/// One of the sampled bridges, whole or without a block, on its way.
struct Case {
  std::size_t bridge;
  Scene scene;
  State state;
};

/// Solves a stage of each case, side by side; those that do not stand are left out.
template <class MakeTask>
std::vector<Case> solve(QuasiStaticSolver& solver, const std::vector<Model>& bridges,
                        const std::vector<Case>& cases, MakeTask make_task) {
  std::vector<StageTask> tasks;
  for (const Case& one : cases) {
    tasks.push_back(make_task(one));
    tasks.back().stage.scene = one.scene;
    tasks.back().parameters = &bridges[one.bridge].parameters;
  }
  std::vector<Solution> solutions = solver.solve(tasks);
  std::vector<Case> standing;
  for (std::size_t i = 0; i < cases.size(); ++i)
    if (stands(solutions[i])) standing.push_back({cases[i].bridge, cases[i].scene, std::move(solutions[i])});
  return standing;
}

/// A bridge warms and its supports move slowly, so that joints slide on the way: in so many parts.
constexpr int kPartsOfWay = 16;

/// Where they are after they have gone from one epoch to the next; `from` and `to` have a stage for each
/// bridge.
std::vector<Case> go_to_epoch(QuasiStaticSolver& solver, const std::vector<Model>& bridges,
                              const std::vector<Stage>& from, const std::vector<Stage>& to,
                              std::vector<Case> cases) {
  for (int part = 1; part <= kPartsOfWay; ++part)
    cases = solve(solver, bridges, cases, [&](const Case& before) {
      return StageTask{.stage = on_the_way(from[before.bridge], to[before.bridge],
                                           static_cast<double>(part) / kPartsOfWay),
                       .start = &before.state.displacement,
                       .before = &before.state};
    });
  return cases;
}

/// The intact bridges at rest. Those that have no equilibrium under their weight are set in motion, each with
/// a solver of its own; what does not stand then is left out.
std::vector<Case> stand_at_rest(QuasiStaticSolver& solver, const std::vector<Model>& bridges) {
  std::vector<StageTask> tasks;
  for (const Model& bridge : bridges) tasks.push_back({.stage = {}, .parameters = &bridge.parameters});
  std::vector<Case> cases;
  for (std::size_t b = 0; Solution & solution : solver.solve(tasks)) {
    const StageTask at_rest{.stage = {}};
    if (!stands(solution)) solution = CombinedSolver(bridges[b]).solve({&at_rest, 1}).front();
    if (stands(solution)) cases.push_back({b, {}, std::move(solution)});
    ++b;
  }
  return cases;
}

/// The cases, if they are all of so many intact bridges.
std::vector<Case> if_all_stand(std::vector<Case> cases, std::size_t bridges, const std::string& name) {
  for (std::size_t b = 0; b < bridges; ++b)
    if (b == cases.size() || cases[b].bridge != b)
      throw Failure(fmt::format("{}: intact bridge {} does not stand", name, b + 1));
  return cases;
}

constexpr std::uint64_t kEpochs =
    1u << 30;  // beyond the numbers of bridges, which have seeds of the same series
constexpr std::uint64_t kUnevenness = 1;  // of the seeds of an epoch

/// Where a share of the bridge's length ends [m].
double end_of(const Model& bridge, double share) {
  const auto x = bridge.mesh.nodes.row(0);
  return std::lerp(x.minCoeff(), x.maxCoeff(), share);
}

/// What each block is warmer by [K].
Eigen::ArrayXd warmed_blocks(const Model& bridge, const Between& between) {
  const double end = end_of(bridge, between.warmer_part);
  Eigen::ArrayXd warmth = Eigen::ArrayXd::Zero(static_cast<Eigen::Index>(bridge.layout.size()));
  for (std::size_t b = 0; b < bridge.layout.size(); ++b)
    if (centroid(bridge.layout.blocks[b].polygon).x() <= end)
      warmth[static_cast<Eigen::Index>(b)] = between.warmer;
  return warmth;
}

/// The share of its stiffness that each joint keeps.
Eigen::ArrayXd softened_joints(const Model& bridge, const Between& between) {
  const double end = end_of(bridge, between.softened_part);
  Eigen::ArrayXd shares = Eigen::ArrayXd::Ones(static_cast<Eigen::Index>(bridge.joints.size()));
  for (std::size_t j = 0; j < bridge.joints.size(); ++j)
    if (middle_of(bridge.joints[j], bridge.mesh).x() <= end)
      shares[static_cast<Eigen::Index>(j)] = between.joint_stiffness;
  return shares;
}

/// What an epoch does to the bridges.
std::vector<Stage> stages_of_epoch(const Model& bridge, const SampledTruth& truth, const Between& between,
                                   int epoch) {
  const UncertainParameters uncertain = uncertain_parameters(bridge, truth.uncertainty);
  const Unevenness uneven = unevenness_of(bridge, truth.uncertainty);
  std::vector<Stage> stages;
  for (int b = 0; b < truth.bridges; ++b) {
    Stage stage;
    if (between.at_random) {
      const std::uint64_t epochs = series_seed(truth.seed, kEpochs + static_cast<std::uint64_t>(epoch));
      const std::uint64_t seed = series_seed(epochs, static_cast<std::uint64_t>(b));
      stage = in_epoch(stage, bridge, uncertain, sampled_theta(uncertain.of_epoch.size(), seed));
      stage = with_unevenness(std::move(stage), bridge, uneven, series_seed(seed, kUnevenness));
    } else if (epoch > 1) {
      stage.uneven_temperature = warmed_blocks(bridge, between);
      stage.joint_stiffness = softened_joints(bridge, between);
      if (between.settlement != 0.0)
        stage.support_movement = rigid_movement(bridge, 0, {0.0, -between.settlement}, 0.0);
    }
    stages.push_back(std::move(stage));
  }
  return stages;
}

/// "truck" of "truck@2"
std::string load_case_of(const std::string& stage) {
  return stage.substr(0, stage.find('@'));
}

/// The forces of a load case, stage by stage up to this one.
std::vector<Field> forces_of(const std::string& load, const Model& bridge,
                             const BridgeDescription& description) {
  if (load.empty()) return {};
  const StatePlan plan =
      plan_states(state_names(kBuiltState, load_case_of(load), description.loads), bridge, description);
  std::vector<Field> forces;
  for (const PlannedState& state : plan) {
    if (state.is_load) forces.push_back(state.load);
    if (load_stage_of(state.name) == load) return forces;
  }
  throw InputError(fmt::format("--load: the load case has no stage {}", in_quotes(load)));
}

/// Sampled bridges that stand intact in the first of two epochs.
struct EpochsOfBridges {
  Model nominal;
  std::vector<Model> bridges;
  std::vector<Stage> first, second;
  std::vector<Field> load;          ///< forces_of
  std::vector<Case> built, before;  ///< of each bridge

  EpochsOfBridges(const BridgeDescription& description, const SampledTruth& truth, const Between& between)
      : nominal(make_model(description)),
        first(stages_of_epoch(nominal, truth, between, 1)),
        second(stages_of_epoch(nominal, truth, between, 2)),
        load(forces_of(truth.load, nominal, description)) {
    for (const VariantParameters& parameters :
         sampled_variants(nominal, truth.uncertainty, truth.bridges, truth.seed))
      bridges.push_back(variant_of(nominal, parameters));
    QuasiStaticSolver solver(nominal);
    built = if_all_stand(stand_at_rest(solver, bridges), bridges.size(), truth.name);
    before = if_all_stand(go_to_epoch(solver, bridges, at_rest(), first, built), bridges.size(), truth.name);
  }

  std::vector<Stage> at_rest() const { return std::vector<Stage>(bridges.size()); }

  /// What the control points show.
  std::vector<double> shown(const Case& one) const {
    const Eigen::VectorXd vertical = readings_at(nominal.control_points, one.state.displacement);
    return {vertical.begin(), vertical.end()};
  }

  /// What the load adds to each case in its epoch: nothing without a load, and of those that do not bear it
  /// no answer.
  std::vector<std::optional<std::vector<double>>> added(QuasiStaticSolver& solver,
                                                        const std::vector<Stage>& epoch,
                                                        const std::vector<Case>& cases) const {
    std::vector<std::optional<std::vector<double>>> result(cases.size());
    if (load.empty()) {
      std::ranges::fill(result, std::vector<double>());
      return result;
    }
    std::vector<Case> loaded = cases;
    for (const Field& force : load)
      loaded = solve(solver, bridges, loaded, [&](const Case& one) {
        StageTask task{.stage = epoch[one.bridge], .start = &one.state.displacement, .before = &one.state};
        task.stage.load = force;
        return task;
      });
    for (std::size_t i = 0; const Case& one : loaded) {
      while (cases[i].bridge != one.bridge || cases[i].scene != one.scene) ++i;
      result[i] = added_by_load(shown(one), shown(cases[i]));
    }
    return result;
  }
};

/// Of one bridge: what is left of it when a block goes in the first epoch and it enters the second; and when
/// it was built without the block.
TrueBridge lose_each(const EpochsOfBridges& sampled, std::size_t number, const std::vector<BlockId>& blocks) {
  const State &built = sampled.built[number].state, &before = sampled.before[number].state;
  QuasiStaticSolver solver(sampled.nominal);
  std::vector<Case> losses;
  for (const BlockId block : blocks) losses.push_back({number, Scene{{block}}, {}});
  const auto enter_second = [&](const std::vector<Stage>& from, std::vector<Case> cases) {
    return go_to_epoch(solver, sampled.bridges, from, sampled.second, std::move(cases));
  };
  const auto lost = enter_second(sampled.first, solve(solver, sampled.bridges, losses, [&](const Case&) {
                                   return StageTask{.stage = sampled.first[number],
                                                    .start = &before.displacement,
                                                    .before = &before,
                                                    .steps = kStepsOfLoss};
                                 }));
  const auto without =
      enter_second(sampled.at_rest(), solve(solver, sampled.bridges, losses, [&](const Case&) {
                     return StageTask{.stage = {}, .start = &built.displacement};
                   }));
  const auto added = sampled.added(solver, sampled.second, lost);
  const auto added_before = sampled.added(solver, sampled.first, {sampled.before[number]}).front();
  if (!added_before) return {};
  TrueBridge result{sampled.shown(sampled.before[number]), {}, *added_before};
  for (std::size_t i = 0; i < lost.size(); ++i) {
    const auto same = std::ranges::find(without, lost[i].scene, &Case::scene);
    if (same != without.end() && added[i])
      result.damaged.push_back({lost[i].scene, sampled.shown(*same), sampled.shown(lost[i]), *added[i]});
  }
  return result;
}

std::string list_of(const std::vector<Scene>& scenes, const BlockLayout& layout) {
  std::string text;
  for (const Scene& scene : scenes) text += (text.empty() ? "" : ";") + to_string(scene, layout);
  return text;
}

}  // namespace

Uncertainty scattered_joints(double scatter, double regional) {
  return {.joint_stiffness = scatter,
          .regional_stiffness = regional,
          .common_stiffness = 0.0,
          .stiffness_ratio = 0.0,
          .friction = 0.0,
          .young_modulus = 0.0,
          .density = 0.0,
          .temperature = 0.0,
          .foot_movement = 0.0,
          .foot_rotation = 0.0,
          .side_movement = 0.0,
          .epoch_stiffness = 0.0,
          .epoch_unevenness = 0.0,
          .uneven_temperature = 0.0};
}

DamagedTruth solve_damaged(const BridgeFile& bridge, const SampledTruth& truth, const std::string& scenes,
                           const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  BuildRequest request;
  request.bridge = bridge;
  request.output = folder / (truth.name + (truth.load.empty() ? "" : ", " + truth.load) + ".h5");
  request.scenes = scenes;
  request.histories = "built,lost";
  if (!truth.load.empty()) request.loads = load_case_of(truth.load);
  request.fields = KeepField::no;
  request.known_bridge = true;  // nothing is looked up in it
  request.other_variants =
      sampled_variants(make_model(bridge.description), truth.uncertainty, truth.bridges, truth.seed);
  Progress progress(Progress::Mode::automatic);
  build_database(request, quasi_static(), progress);
  return {truth.name, read_true_bridges(Database::open(request.output), truth.load)};
}

IntactTruth solve_intact(const BridgeDescription& description, const SampledTruth& truth,
                         const Between& between) {
  const EpochsOfBridges sampled(description, truth, between);
  QuasiStaticSolver solver(sampled.nominal);
  const auto after =
      if_all_stand(go_to_epoch(solver, sampled.bridges, sampled.first, sampled.second, sampled.before),
                   sampled.bridges.size(), truth.name);
  const auto added_before = sampled.added(solver, sampled.first, sampled.before);
  const auto added_after = sampled.added(solver, sampled.second, after);
  IntactTruth result{truth.name, {}};
  for (std::size_t b = 0; b < sampled.bridges.size(); ++b)
    if (added_before[b] && added_after[b])
      result.bridges.push_back(
          {sampled.shown(sampled.before[b]), sampled.shown(after[b]), *added_before[b], *added_after[b]});
  return result;
}

DamagedTruth solve_lost_between(const BridgeDescription& description, const SampledTruth& truth,
                                const Between& between, const std::vector<BlockId>& blocks,
                                std::size_t every) {
  const EpochsOfBridges sampled(description, truth, between);
  DamagedTruth result{truth.name, std::vector<TrueBridge>(sampled.bridges.size())};
  for_each_index_on_threads(sampled.bridges.size(), hardware_threads(), [&](std::size_t b) {
    std::vector<BlockId> some;
    for (std::size_t i = b % every; i < blocks.size(); i += every) some.push_back(blocks[i]);
    result.bridges[b] = lose_each(sampled, b, some);
  });
  return result;
}

std::vector<BlockId> wall_blocks(const BlockLayout& layout) {
  std::vector<BlockId> wall;
  for (std::size_t b = 0; b < layout.size(); ++b)
    if (layout.blocks[b].role == BlockRole::wall) wall.push_back(BlockId{static_cast<std::int32_t>(b)});
  return wall;
}

std::string wall_singles(const BlockLayout& layout) {
  std::vector<Scene> scenes = {Scene{}};
  for (const BlockId block : wall_blocks(layout)) scenes.push_back(Scene{{block}});
  return list_of(scenes, layout);
}

std::string random_pairs(const BlockLayout& layout, int count, std::uint64_t seed) {
  const std::vector<BlockId> wall = wall_blocks(layout);
  const std::size_t pairs = wall.size() * (wall.size() - std::min<std::size_t>(wall.size(), 1)) / 2;
  if (count < 0 || static_cast<std::size_t>(count) > pairs)
    throw InputError(
        fmt::format("{} random pairs of wall blocks, expected at most the {} that there are", count, pairs));
  const auto draw = [&](Random& random) {
    return wall[random.below(static_cast<std::uint32_t>(wall.size()))];
  };
  Random random(seed);
  std::set<Scene> scenes = {Scene{}};
  while (static_cast<int>(scenes.size()) <= count) {
    const BlockId first = draw(random), second = draw(random);
    if (first != second) scenes.insert(Scene{{std::min(first, second), std::max(first, second)}});
  }
  return list_of({scenes.begin(), scenes.end()}, layout);
}

}  // namespace voussoir
