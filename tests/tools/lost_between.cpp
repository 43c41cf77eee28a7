/// @file Blocks that are lost between two epochs. Oracles: the databases that build-database makes of the
/// same bridges, which know of no epochs; what the intact bridge does in the same epochs.

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/made_up_database.h"
#include "tests/support/temporary_folder.h"
#include "tools/trials/sampled_truth.h"

using namespace voussoir;

namespace {

/// Over the points that both have.
double mean_change(const std::vector<double>& from, const std::vector<double>& to) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < from.size(); ++i)
    if (!std::isnan(to[i])) sum += to[i] - from[i], ++count;
  return sum / count;
}

}  // namespace

TEST_CASE("If nothing happens but the loss, it is that of the database (build-database)") {
  test::TemporaryFolder folder;
  const BridgeFile file = test::small_bridge_file();
  const SampledTruth truth{"joints", scattered_joints(0.2), 2, 1};
  const DamagedTruth stored = solve_damaged(file, truth, "intact;4,2..3", folder.path());
  std::vector<BlockId> blocks;
  for (const TrueScene& scene : stored.bridges[0].damaged) blocks.push_back(scene.scene.removed.front());
  REQUIRE(blocks.size() == 2);
  const DamagedTruth solved = solve_lost_between(file.description, truth, {}, blocks);
  REQUIRE(solved.bridges.size() == 2);
  for (std::size_t b = 0; b < 2; ++b) {
    REQUIRE(solved.bridges[b].damaged.size() == 2);
    for (std::size_t k = 0; k < 2; ++k) {
      const TrueScene &expected = stored.bridges[b].damaged[k], &found = solved.bridges[b].damaged[k];
      CHECK(found.scene == expected.scene);
      for (std::size_t point = 0; point < expected.lost.size(); ++point) {
        CHECK(std::isnan(found.lost[point]) == std::isnan(expected.lost[point]));
        if (std::isnan(expected.lost[point])) continue;
        CHECK(found.lost[point] == Approx(expected.lost[point]).margin(1e-8));
        CHECK(found.built[point] == Approx(expected.built[point]).margin(1e-8));
      }
    }
  }
}

TEST_CASE("What a load adds is that of the database, in its second step, too (build-database)") {
  test::TemporaryFolder folder;
  const BridgeFile small = test::small_bridge_file();
  const BridgeFile file = parse_bridge_file(small.text + R"(
    [[loads]]
    name = "cart"
    axles = [{ at_m = 0.0, force_N = 20e3 }]
    from_m = 2.0
    to_m = 3.0
    steps = 2
  )",
                                            "small");
  const SampledTruth truth{"joints", scattered_joints(0.2), 2, 1, "cart@2"};
  const DamagedTruth stored = solve_damaged(file, truth, "intact;4,2", folder.path());
  const std::vector<BlockId> blocks = {stored.bridges[0].damaged.at(0).scene.removed.front()};
  const DamagedTruth solved = solve_lost_between(file.description, truth, {}, blocks);
  const IntactTruth intact = solve_intact(file.description, truth, {});
  for (std::size_t b = 0; b < 2; ++b) {
    const std::vector<double>&expected = stored.bridges[b].damaged.at(0).added,
          &found = solved.bridges[b].damaged.at(0).added;
    double largest = 0.0;
    for (std::size_t point = 0; point < expected.size(); ++point) {
      CHECK(stored.bridges[b].added[point] == Approx(solved.bridges[b].added[point]).margin(1e-8));
      CHECK(intact.bridges[b].added_before[point] == Approx(solved.bridges[b].added[point]).margin(1e-8));
      CHECK(intact.bridges[b].added_after[point] == Approx(solved.bridges[b].added[point]).margin(1e-8));
      CHECK(std::isnan(found[point]) == std::isnan(expected[point]));
      if (std::isnan(expected[point])) continue;
      CHECK(found[point] == Approx(expected[point]).margin(1e-8));
      largest = std::max(largest, std::abs(expected[point]));
    }
    CHECK(largest > 1e-5);
  }
  CHECK_THROWS_WITH(solve_intact(file.description, {"none", {}, 1, 1, "cart@3"}, {}),
                    Catch::Matchers::Contains("no stage 'cart@3'"));
}

TEST_CASE("A bridge that warms after a loss rises as the intact one does") {
  const BridgeDescription description = test::small_bridge_file().description;
  const SampledTruth truth{"joints", scattered_joints(0.2), 2, 1};
  const Between warmer{.warmer = 10.0};
  const std::vector<BlockId> wall = wall_blocks(make_model(description).layout);
  const std::vector<BlockId> blocks = {wall[wall.size() / 2]};
  const DamagedTruth cold = solve_lost_between(description, truth, {}, blocks),
                     warm = solve_lost_between(description, truth, warmer, blocks);
  const IntactTruth intact = solve_intact(description, truth, warmer);
  for (std::size_t b = 0; b < 2; ++b) {
    REQUIRE(warm.bridges[b].damaged.size() == 1);
    CHECK(warm.bridges[b].intact == intact.bridges[b].before);
    const double rise = mean_change(intact.bridges[b].before, intact.bridges[b].after);
    const TrueScene &before = cold.bridges[b].damaged[0], &after = warm.bridges[b].damaged[0];
    CHECK(mean_change(before.lost, after.lost) == Approx(rise).epsilon(0.2));
    CHECK(mean_change(before.built, after.built) == Approx(rise).epsilon(0.2));
  }
}
