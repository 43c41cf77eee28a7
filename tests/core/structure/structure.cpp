#include "core/structure/structure.h"

#include <catch2/catch.hpp>

#include "core/bridge_file/bridge_file.h"
#include "core/error.h"
#include "tests/support/bridges.h"

using namespace voussoir;

namespace {

Block square(const std::string& label, double x, double y) {
  Block block;
  block.label = label;
  block.polygon = {{x, y}, {x + 1.0, y}, {x + 1.0, y + 1.0}, {x, y + 1.0}};
  return block;
}

}  // namespace

TEST_CASE("Blocks given as polygons are found by their labels and meet where they touch", "[structure]") {
  const Structure pile =
      assemble({square("foot", 0.0, 0.0), square("head", 0.0, 1.0)}, {.mesh = {}, .mirror_axis = 0.5});
  CHECK(pile.layout.find_label("head") == BlockId{1});
  CHECK_FALSE(pile.layout.find_label("hat"));
  CHECK(pile.layout.blocks[0].index.course < 0);
  double length = 0.0;
  for (const Joint& joint : pile.joints) length += joint.length;
  CHECK(length == Approx(1.0));  // one face of 1 m
  CHECK(pile.symmetry.has_value());
  CHECK(to_string(parse_scene("head", pile.layout), pile.layout) == "head");
  CHECK_THROWS_WITH(parse_scene("hat", pile.layout), Catch::Contains("or a label such as foot"));
}

TEST_CASE("Two blocks of one label, and polygons that run clockwise, are refused by their label",
          "[structure]") {
  CHECK_THROWS_WITH(assemble({square("a", 0.0, 0.0), square("a", 2.0, 0.0)}, {}),
                    "two blocks are called 'a': expected a label of its own for each block");
  Block inside_out = square("b", 0.0, 0.0);
  std::reverse(inside_out.polygon.begin(), inside_out.polygon.end());
  CHECK_THROWS_WITH(assemble({inside_out}, {}),
                    "block 'b': expected at least three corners, counter-clockwise");
}

TEST_CASE(
    "The reference bridge is held at its foot and, sideways, at its ends (by the coordinates of all nodes)",
    "[structure]") {
  const Model bridge = test::reference_bridge();
  const std::vector<bool> held = held_components(bridge.supports, bridge.mesh);
  std::size_t held_count = 0;
  for (int node = 0; node < bridge.mesh.node_count(); ++node) {
    const Point x = bridge.mesh.nodes.col(node);
    const bool base = x.y() == 0.0;
    const bool side = x.x() == 0.0 || x.x() == 20.0;
    CHECK(held[static_cast<std::size_t>(2 * node)] == (base || side));
    CHECK(held[static_cast<std::size_t>(2 * node + 1)] == base);
    held_count += base || side;
  }
  CHECK(held_count > 40);
}

TEST_CASE("A ring that stands on nothing is refused: its springing lies above the wall", "[structure]") {
  const auto described = [](double springing) {
    return parse_bridge_file(
               fmt::format("[wall]\nlength_m = 12.0\ncourses = 8\n[[spans]]\nshape = \"segmental\"\n"
                           "centre_x_m = 6.0\nspringing_m = {}\nspan_m = 6.0\nrise_m = 1.5\n"
                           "ring_thickness_m = 0.4\nvoussoirs = 15\n",
                           springing),
               "b.toml")
        .description;
  };
  CHECK_NOTHROW(make_structure(described(1.2)));
  CHECK_THROWS_WITH(make_structure(described(12.0)),
                    Catch::Contains("block '0,1'") && Catch::Contains("is loose"));
}

TEST_CASE("Ring blocks know their ring, wall blocks have none", "[structure]") {
  BridgeDescription description;
  description.wall.length = 20.0;
  description.spans = {{.centre_x = 5.0, .intrados_radius = 3.0}, {.centre_x = 15.0, .intrados_radius = 3.0}};
  const Structure bridge = make_structure(description);
  CHECK(bridge.layout.count_with(BlockRole::ring) == 38);
  for (const Block& block : bridge.layout.blocks)
    CHECK(block.ring == (block.role == BlockRole::wall        ? kNoRing
                         : centroid(block.polygon).x() < 10.0 ? 0
                                                              : 1));
}

TEST_CASE(
    "Embedded courses are held by the foot below them, the top by its own (by the coordinates of all nodes)",
    "[structure]") {
  BridgeDescription description = test::small_description();
  description.supports.embedded_courses = 1;
  description.supports.top = SupportKind::clamped;
  const Model bridge = make_model(description);
  std::vector<int> holders(static_cast<std::size_t>(bridge.mesh.node_count()), 0);
  for (const Support& support : bridge.supports) {
    if (!support.is_foot && support.name != "top") continue;
    for (const NodeId node : support.nodes) {
      const Point at = bridge.mesh.position(node);
      ++holders[static_cast<std::size_t>(value(node))];
      if (support.name == "foot 1") CHECK(at.x() < 3.0);
      if (support.name == "foot 2") CHECK(at.x() > 3.0);
      CHECK((support.name == "top" ? at.y() >= 2.0 : at.y() <= 0.5));
    }
  }
  for (std::size_t b = 0; b < bridge.layout.size(); ++b) {
    const int course = bridge.layout.blocks[b].index.course;
    if (course != 1 && course != 5) continue;
    for (int node = bridge.mesh.block_nodes[b].begin; node < bridge.mesh.block_nodes[b].end; ++node)
      CHECK(holders[static_cast<std::size_t>(node)] == 1);
  }
}

TEST_CASE("Held tops and courses of blocks that have none are refused", "[structure][bridge-file]") {
  const auto read = [](const std::string& text) { return parse_bridge_file(text, "b.toml"); };
  const std::string block = "blocks = [{label = \"a\", vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]}]\n";
  CHECK_NOTHROW(read(block));
  CHECK_THROWS_WITH(read(block + "[supports]\ntop = \"clamped\"\n"),
                    "b.toml:3: top in [supports]: is held: expected free: blocks that are given one by one "
                    "have no top course");
  CHECK_THROWS_WITH(
      read(block + "[supports]\nembedded_courses = 1\n"),
      "b.toml:3: embedded_courses in [supports]: is 1: expected 0: blocks that are given one by "
      "one lie in no courses");
  CHECK_THROWS_WITH(read("[wall]\ncourses = 0\n[supports]\ntop = \"roller\"\n"),
                    "b.toml:4: top in [supports]: is held: expected courses in [wall], whose top it is");
}

TEST_CASE("A structure in which nothing can move is refused", "[structure]") {
  BridgeDescription wall;
  wall.spans.clear();
  wall.wall.courses = 1;
  wall.supports = {.base = SupportKind::clamped, .sides = SupportKind::clamped, .embedded_courses = 1};
  CHECK_THROWS_WITH(make_structure(wall), Catch::Matchers::Contains("expected a structure that can move"));
  wall.wall.courses = 2;
  CHECK_NOTHROW(make_structure(wall));
}
