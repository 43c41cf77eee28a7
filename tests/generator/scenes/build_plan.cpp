#include <algorithm>
#include <catch2/catch.hpp>
#include <iterator>
#include <set>

#include "core/solve/state_name.h"
#include "core/structure/mirror_symmetry.h"
#include "generator/scenes/build_plan.h"
#include "generator/scenes/scene_list.h"
#include "tests/support/made_up_database.h"

namespace voussoir {
namespace {

const Model& small_bridge() {
  static const Model bridge = make_model(test::small_bridge_file().description);
  return bridge;
}

bool nothing(const RecordKey&) {
  return false;
}

StatePlan states_of(const std::vector<std::string>& names) {
  return plan_states(names, small_bridge(), BridgeDescription{});
}

/// The plan of scenes of one bridge.
BuildPlan plan_of(const std::vector<Scene>& wanted, const Model& bridge, const PlanRules& rules,
                  const std::function<bool(const RecordKey&)>& is_known,
                  const StatePlan& states = states_of({kBuiltState})) {
  return plan_build(keys_of(kNominalVariant, wanted), {std::span(&bridge, 1), rules, states},
                    {is_known, is_known});
}

std::multiset<Scene> recorded(const BuildPlan& plan) {
  std::multiset<Scene> scenes;
  for (const auto& stage : plan.stages)
    for (const SolvingTask& task : stage) {
      if (task.records_solved) scenes.insert(task.solved);
      if (task.image) scenes.insert(*task.image);
    }
  return scenes;
}

std::size_t solved(const BuildPlan& plan) {
  std::size_t count = 0;
  for (const auto& stage : plan.stages) count += stage.size();
  return count;
}

}  // namespace

TEST_CASE("Every wanted scene is recorded exactly once, with and without mirror images") {
  const auto scenes = all_scenes(small_bridge().layout.size(), 2);
  for (const bool mirror : {false, true}) {
    const auto records =
        recorded(plan_of(scenes, small_bridge(), PlanRules{.mirror_images = mirror}, nothing));
    CHECK(records == std::multiset<Scene>(scenes.begin(), scenes.end()));
  }
}

TEST_CASE("Mirror symmetry halves what is solved, but for scenes that are their own image") {
  REQUIRE(small_bridge().symmetry.has_value());
  const auto scenes = all_scenes(small_bridge().layout.size(), 2);
  const auto own_image =
      static_cast<std::size_t>(std::count_if(scenes.begin(), scenes.end(), [](const Scene& scene) {
        return mirrored(scene, *small_bridge().symmetry) == scene;
      }));
  CHECK(solved(plan_of(scenes, small_bridge(), PlanRules{.mirror_images = false}, nothing)) == scenes.size());
  CHECK(solved(plan_of(scenes, small_bridge(), PlanRules{}, nothing)) == (scenes.size() + own_image) / 2);
}

TEST_CASE("A bridge without symmetry has every scene solved") {
  Model lopsided = small_bridge();
  lopsided.symmetry.reset();
  const auto scenes = all_scenes(lopsided.layout.size(), 1);
  CHECK(solved(plan_of(scenes, lopsided, PlanRules{}, nothing)) == scenes.size());
}

TEST_CASE("What a pair starts from is solved before it although nobody asked for it") {
  const Scene pair{{BlockId{0}, BlockId{3}}};
  const auto plan = plan_of({pair}, small_bridge(), PlanRules{.mirror_images = false}, nothing);
  REQUIRE(plan.stages.size() == 4);
  REQUIRE(plan.stages[0].size() == 1);
  CHECK(plan.stages[0][0].solved == Scene{});
  REQUIRE(plan.stages[1].size() == 2);
  CHECK(plan.stages[1][0].solved == Scene{{BlockId{0}}});
  CHECK(plan.stages[1][1].solved == Scene{{BlockId{3}}});
  REQUIRE(plan.stages[2].size() == 1);
  CHECK(plan.stages[2][0].solved == pair);
}

TEST_CASE("Without warm starts nothing is solved that nobody asked for") {
  const Scene pair{{BlockId{0}, BlockId{3}}};
  CHECK(solved(plan_of({pair}, small_bridge(), PlanRules{.warm_starts = false}, nothing)) == 1);
}

TEST_CASE("Where blocks are lost the intact bridge and singles are solved before, even without warm starts") {
  const Scene pair{{BlockId{0}, BlockId{3}}};
  const auto plan =
      plan_of({pair}, small_bridge(), PlanRules{.warm_starts = false}, nothing, states_of({kLostState}));
  REQUIRE(plan.stages[0].size() == 1);
  CHECK(plan.stages[0][0].solved == Scene{});
  REQUIRE(plan.stages[1].size() == 2);  // they say in how many steps the pair goes
  CHECK(plan.stages[1][0].solved == Scene{{BlockId{0}}});
  CHECK(plan.stages[1][1].solved == Scene{{BlockId{3}}});
}

TEST_CASE("A mirror image under a one-sided load starts from its own singles (written out)") {
  BridgeDescription description = test::small_bridge_file().description;
  for (const double x : {3.0, 1.0}) {  // in the middle, and on one side
    description.loads = {{"p", {{x, 1e3}}, {}, {}, {}, std::nullopt, false}};
    const StatePlan states = plan_states({kBuiltState, "built:p"}, small_bridge(), description);
    const Scene pair{{BlockId{0}, BlockId{3}}};
    const Scene image = mirrored(pair, *small_bridge().symmetry);
    const auto starts = starting_scenes(pair, image, PlanRules{}, states);
    CHECK(starts.size() == (x == 3.0 ? 3 : 5));
    for (const BlockId block : image.removed)
      CHECK(std::ranges::count(starts, Scene{{block}}) == (x == 3.0 ? 0 : 1));
  }
}

TEST_CASE("A scene whose record is known but cannot start others is solved again for those (written out)") {
  const Scene pair{{BlockId{0}, BlockId{3}}};
  const std::vector<Scene> wanted = {Scene{}, Scene{{BlockId{0}}}, Scene{{BlockId{3}}}, pair};
  const StatePlan states = states_of({kLostState});
  const auto all_but_pair = [&](const RecordKey& key) { return key.scene != pair; };
  const auto solved_for = [&](const std::vector<Scene>& scenes) {
    return solved(plan_build(keys_of(kNominalVariant, scenes),
                             {std::span(&small_bridge(), 1), PlanRules{.mirror_images = false}, states},
                             {all_but_pair, nothing}));
  };
  CHECK(solved_for(wanted) == 4);
  CHECK(solved_for({wanted.begin(), wanted.end() - 1}) == 0);
}

TEST_CASE("Which of a scene and its image is solved does not depend on which one is wanted") {
  const Scene scene{{BlockId{0}, BlockId{3}}};
  const Scene image = mirrored(scene, *small_bridge().symmetry);
  REQUIRE(scene != image);
  for (const Scene& wanted : {scene, image}) {
    const auto plan = plan_of({wanted}, small_bridge(), PlanRules{}, nothing);
    REQUIRE(plan.stages[2].size() == 1);
    CHECK(plan.stages[2][0].solved == std::min(scene, image));
    CHECK(recorded(plan).contains(wanted));
  }
}

TEST_CASE("Every variant is solved for itself, by its own symmetry and from its own intact bridge") {
  std::vector<Model> bridges = {small_bridge(), small_bridge()};
  bridges[1].symmetry.reset();
  const Scene pair{{BlockId{0}, BlockId{3}}};
  const Scene image = mirrored(pair, *small_bridge().symmetry);
  const std::vector<Scene> wanted = {std::min(pair, image), std::max(pair, image)};
  std::vector<RecordKey> keys = keys_of(0, wanted);
  std::ranges::move(keys_of(1, wanted), std::back_inserter(keys));
  const auto known = [](const RecordKey& key) { return key == RecordKey{0, Scene{}}; };
  const StatePlan states = states_of({kBuiltState});
  const BuildPlan plan = plan_build(keys, {bridges, PlanRules{}, states}, {known, known});
  const auto count = [&](std::size_t stage, std::int32_t variant) {
    return std::ranges::count(plan.stages[stage], variant, &SolvingTask::variant);
  };
  CHECK(count(0, 0) == 0);  // known
  CHECK(count(0, 1) == 1);
  CHECK(count(1, 1) == 4);
  CHECK(count(2, 0) == 1);  // one answers for both
  CHECK(count(2, 1) == 2);
  for (const auto& stage : plan.stages)
    CHECK(std::ranges::is_sorted(stage, std::less<>(), &SolvingTask::variant));
}

TEST_CASE("Known scenes are not solved again") {
  const auto scenes = all_scenes(small_bridge().layout.size(), 2);
  const auto is_known = [](const RecordKey& key) {
    return key.scene.missing() < 2 || value(key.scene.removed[0]) > 0;
  };
  std::multiset<Scene> unknown(scenes.begin(), scenes.end());
  std::erase_if(unknown, [&](const Scene& scene) { return is_known({kNominalVariant, scene}); });
  REQUIRE(unknown.size() == 37);  // pairs with block 0
  for (const bool mirror : {false, true})
    CHECK(recorded(plan_of(scenes, small_bridge(), PlanRules{.mirror_images = mirror}, is_known)) == unknown);
}

}  // namespace voussoir
