/// Blocks that are known to be missing. Oracle: the whole bridge, and its scene without these blocks.

#include "core/structure/gone_blocks.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "core/error.h"
#include "core/solve/combined_solver.h"
#include "tests/support/bridges.h"

using namespace voussoir;
using Catch::Matchers::Contains;

namespace {

BridgeDescription without(const std::vector<std::string>& labels) {
  BridgeDescription description = test::small_description();
  description.control_points.face = true;
  description.missing_blocks = labels;
  return description;
}

Field settled(const Model& bridge, const Scene& scene) {
  CombinedSolver solver(bridge);
  const Solution solution = solver.solve(std::vector<StageTask>{{.stage = {.scene = scene}}}).front();
  REQUIRE(stands(solution));
  return solution.displacement;
}

}  // namespace

TEST_CASE("A bridge without a block is the whole bridge's scene without it, its points named alike") {
  const Model whole = make_model(without({}));
  for (const std::string gone : {"5,2", "2,4", "3,3"}) {
    INFO(gone);
    const Model left = make_model(without({gone}));
    const Scene scene = parse_scene(gone, whole.layout);
    REQUIRE(left.layout.size() + 1 == whole.layout.size());
    const Eigen::VectorXd expected = readings_at(whole.control_points, settled(whole, scene));
    const Eigen::VectorXd found = readings_at(left.control_points, settled(left, Scene{}));
    std::size_t shown = 0;
    for (std::size_t i = 0; i < whole.control_points.size(); ++i) {
      const ControlPoint& point = whole.control_points[i];
      const auto same = std::ranges::find(left.control_points, point.name, &ControlPoint::name);
      CHECK((same == left.control_points.end()) == lacks(scene, point));
      if (same == left.control_points.end()) continue;
      CHECK(same->position == point.position);
      const auto at = static_cast<Eigen::Index>(same - left.control_points.begin());
      CHECK(found[at] == Approx(expected[static_cast<Eigen::Index>(i)]).epsilon(0.01).margin(1e-7));
      ++shown;
    }
    CHECK(shown == left.control_points.size());
    CHECK_THROWS_WITH(parse_scene(gone, left.layout), Contains("no block " + gone));
  }
}

TEST_CASE("Labels that name no block of the bridge are refused") {
  CHECK_THROWS_WITH(make_model(without({"9,9"})), Contains("missing_blocks: there is no block 9,9"));
  CHECK_THROWS_WITH(make_model(without({"5,2", "5, 2"})), Contains("missing_blocks: ") && Contains("twice"));
  std::vector<std::string> all;
  for (const Block& block : make_model(without({})).layout.blocks) all.push_back(block.label);
  CHECK_THROWS_WITH(make_model(without(all)), Contains("all blocks of the bridge are missing"));
}

TEST_CASE("Regions may name a missing block, which counts for nothing; its points are left out") {
  const std::string regions = "[[regions]]\nof = [\"5,2\", \"4,4\"]\nyoung_modulus_Pa = 1e9\n";
  const std::string text =
      "missing_blocks = [\"5,2\"]\n" + read_bridge_file(test::example_bridge("small")).text + regions;
  const Model left = make_model(parse_bridge_file(text, "small").description);
  CHECK(std::ranges::find(left.control_points, "T3", &ControlPoint::name) == left.control_points.end());
  CHECK(std::ranges::find(left.control_points, "T5", &ControlPoint::name) != left.control_points.end());
  std::size_t soft = 0;
  for (std::size_t b = 0; b < left.layout.size(); ++b)
    soft += left.parameters.blocks[b].young_modulus == 1e9 ? 1 : 0;
  CHECK(soft == 1);
}

TEST_CASE("A bridge file says which blocks are missing") {
  const std::string text =
      "missing_blocks = [\"5,2\", \"2,4\"]\n" + read_bridge_file(test::example_bridge("small")).text;
  CHECK(parse_bridge_file(text, "small").description.missing_blocks ==
        std::vector<std::string>{"5,2", "2,4"});
}
