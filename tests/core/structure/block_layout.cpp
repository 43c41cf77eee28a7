#include "core/structure/block_layout.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/structure/exposed_edges.h"
#include "tests/support/bridges.h"

using namespace voussoir;

TEST_CASE("The reference bridge has the published 212 blocks, 193 of them in the wall", "[layout]") {
  const BlockLayout layout = lay_blocks({});
  REQUIRE(layout.size() == 212);
  const std::vector<int> per_course = {19, 14, 12, 14, 14, 14, 14, 16, 16, 18, 20, 21, 20};
  for (std::size_t course = 0; course < per_course.size(); ++course) {
    INFO("course " << course);
    CHECK(layout.last_position(static_cast<int>(course)) == per_course[course]);
  }
}

TEST_CASE("Blocks that the paper describes are where it describes them", "[layout]") {
  const BlockLayout layout = lay_blocks({});
  const auto centre = [&](int course, int position) {
    return centroid(layout[layout.find({course, position}).value()].polygon);
  };
  CHECK(centre(0, 10).x() == Approx(10.0));                       // keystone
  CHECK(centre(2, 6).x() == Approx(5.5));                         // at the arch, under nodes T10 to T15
  CHECK(centre(4, 10).x() == Approx(20.0 - centre(4, 5).x()));    // mirror neighbour, one block further out
  CHECK(std::abs(centre(6, 4).x() - centre(10, 4).x()) < 1e-12);  // on one vertical
  CHECK(layout[layout.find({10, 12}).value()].kind == BlockKind::cut);  // beside the keystone
}

TEST_CASE("The slivers over the crown have the published area", "[layout]") {
  const BlockLayout layout = lay_blocks({});
  for (const int position : {10, 11})
    CHECK(area(layout[layout.find({10, position}).value()].polygon) == Approx(0.0193).margin(5e-5));
}

TEST_CASE("Blocks fill the wall outside the opening exactly", "[layout]") {
  // Oracle: area of the rectangle minus the polygon inside the intrados chords and the legs.
  const SpanDescription span;
  const double chords = 0.5 * span.voussoirs * span.intrados_radius * span.intrados_radius *
                        std::sin(std::numbers::pi / span.voussoirs);
  double total = 0.0;
  for (const Block& block : lay_blocks({}).blocks) total += area(block.polygon);
  CHECK(total == Approx(20.0 * 6.0 - chords - 7.0 * 1.05).epsilon(1e-12));
}

TEST_CASE("A bridge without spans is a plain wall in running bond", "[layout]") {
  BridgeDescription wall;
  wall.spans.clear();
  wall.wall = {.length = 3.0, .courses = 2, .course_height = 0.5, .block_length = 1.0};
  const BlockLayout layout = lay_blocks(wall);
  CHECK(layout.last_position(1) == 4);  // half, whole, whole, half
  CHECK(layout.last_position(2) == 3);
}

TEST_CASE("Two spans number their arch blocks through from left to right", "[layout]") {
  const Model bridge = make_model(read_bridge_file(test::example_bridge("two-span")).description);
  CHECK(bridge.layout.last_position(0) == 30);
  for (int i = 1; i < 30; ++i)
    CHECK(centroid(bridge.layout.blocks[static_cast<std::size_t>(i)].polygon).x() >
          centroid(bridge.layout.blocks[static_cast<std::size_t>(i - 1)].polygon).x());
}

TEST_CASE("A bridge without blocks is refused", "[layout]") {
  BridgeDescription nothing;
  nothing.spans.clear();
  nothing.wall.courses = 0;
  CHECK_THROWS_AS(lay_blocks(nothing), InputError);
}

TEST_CASE("Two arches given one by one under one ring number are two rings (the bridge that numbers them)",
          "[layout]") {
  BridgeDescription numbered = read_bridge_file(test::example_bridge("two-span")).description;
  numbered.blocks = lay_blocks(numbered).blocks;
  BridgeDescription unnumbered = numbered;
  for (Block& block : unnumbered.blocks)
    if (block.role == BlockRole::ring) block.ring = 0;
  const std::vector<Block> expected = lay_blocks(numbered).blocks, found = lay_blocks(unnumbered).blocks;
  int rings = 0;
  for (std::size_t b = 0; b < expected.size(); ++b) {
    INFO(expected[b].label);
    CHECK(found[b].ring == expected[b].ring);
    CHECK(found[b].intrados == expected[b].intrados);
    rings += expected[b].ring == 1 && expected[b].intrados ? 1 : 0;
  }
  CHECK(rings == 15);
}

TEST_CASE("An upright face that is open towards a ring's middle has two ends, along the ring (by hand)",
          "[layout]") {
  Block leg;
  leg.polygon = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 2.0}, {0.0, 2.0}};
  using Ends = std::array<Point, 2>;
  CHECK(open_face_towards(leg, {leg}, {3.0, 0.0}, 1e-6) == Ends{Point(1.0, 0.0), Point(1.0, 2.0)});
  CHECK(open_face_towards(leg, {leg}, {-2.0, 0.0}, 1e-6) == Ends{Point(0.0, 2.0), Point(0.0, 0.0)});
  // Two edges that lean and stand: from the foot of one to the head of the other.
  leg.polygon = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {1.5, 2.0}, {0.0, 2.0}};
  CHECK(open_face_towards(leg, {leg}, {3.0, 0.0}, 1e-6) == Ends{Point(1.0, 0.0), Point(1.5, 2.0)});
}
