#include "core/structure/mesh.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/geometry/triangulation.h"
#include "tests/support/bridges.h"

using namespace voussoir;

namespace {

Polygon corners(const Mesh& mesh, const Triangle& triangle) {
  return {mesh.position(triangle.nodes[0]), mesh.position(triangle.nodes[1]),
          mesh.position(triangle.nodes[2])};
}

Model bridge_with(bool split, int refinement) {
  BridgeDescription description;
  description.mesh = {.refinement = refinement, .split_at_corners = split};
  return make_model(description);
}

}  // namespace

TEST_CASE("Triangles are counter-clockwise and fill every block exactly", "[mesh]") {
  for (const bool split : {false, true})
    for (const int refinement : {0, 1}) {
      const Model bridge = bridge_with(split, refinement);
      for (std::size_t block = 0; block < bridge.layout.size(); ++block) {
        double total = 0.0;
        for (int t = bridge.mesh.block_triangles[block].begin; t < bridge.mesh.block_triangles[block].end;
             ++t) {
          const double part = area(corners(bridge.mesh, bridge.mesh.triangles[static_cast<std::size_t>(t)]));
          REQUIRE(part > 0.0);
          total += part;
        }
        CHECK(total == Approx(area(bridge.layout.blocks[block].polygon)).epsilon(1e-12));
      }
    }
}

TEST_CASE(
    "A block astride the axis that a ring cuts from below is filled, and alike on both sides (symmetry)",
    "[mesh]") {
  for (const int voussoirs : {9, 10, 15}) {  // an even number has a corner on the axis
    BridgeDescription description = test::small_description();
    description.spans.front() = {.centre_x = 3.0,
                                 .centre_y = 0.4,
                                 .intrados_radius = 0.4,
                                 .ring_thickness = 0.5,
                                 .voussoirs = voussoirs};
    const Model bridge = make_model(description);
    INFO(voussoirs << " voussoirs");
    CHECK(bridge.symmetry.has_value());
    int hollow = 0;
    for (std::size_t block = 0; block < bridge.layout.size(); ++block) {
      const Polygon& polygon = bridge.layout.blocks[block].polygon;
      hollow += !centre_sees_corners(polygon);
      double total = 0.0;
      const IndexRange& range = bridge.mesh.block_triangles[block];
      for (auto t = static_cast<std::size_t>(range.begin); t < static_cast<std::size_t>(range.end); ++t) {
        CHECK(area(corners(bridge.mesh, bridge.mesh.triangles[t])) > 0.0);
        total += area(corners(bridge.mesh, bridge.mesh.triangles[t]));
      }
      CHECK(total == Approx(area(polygon)).epsilon(1e-12));
    }
    CHECK(hollow > 0);
  }
}

TEST_CASE("Without splitting the reference mesh comes near the paper's 529 triangles", "[mesh]") {
  const Model bridge = bridge_with(false, 0);
  CHECK(bridge.mesh.triangles.size() == 507);
  for (std::size_t block = 0; block < bridge.layout.size(); ++block) {
    const int count = bridge.mesh.block_triangles[block].size();
    const Block& b = bridge.layout.blocks[block];
    if (b.kind == BlockKind::leg || b.top_course) CHECK(count == 4);
    if (b.kind == BlockKind::voussoir) CHECK(count == 3);
    // A block on the axis is cut on both sides alike, which takes two more.
    const bool on_axis = std::abs(centroid(b.polygon).x() - 10) < 1e-9;
    if (b.kind == BlockKind::plain && !b.top_course) CHECK(count == (on_axis ? 4 : 2));
  }
}

TEST_CASE("Each level of refinement makes four triangles of one", "[mesh]") {
  CHECK(bridge_with(false, 1).mesh.triangles.size() == 4 * bridge_with(false, 0).mesh.triangles.size());
  CHECK(bridge_with(true, 2).mesh.triangles.size() == 16 * bridge_with(true, 0).mesh.triangles.size());
}

TEST_CASE("Splitting puts a node of a block wherever a neighbour's corner touches it", "[mesh]") {
  // Oracle: brute force over all corners and all blocks.
  const Model bridge = bridge_with(true, 0);
  int touching = 0;
  for (std::size_t block = 0; block < bridge.layout.size(); ++block)
    for (const Block& other : bridge.layout.blocks)
      for (const Point& corner : other.polygon) {
        if (distance_to_boundary(bridge.layout.blocks[block].polygon, corner) > 1e-9) continue;
        const IndexRange nodes = bridge.mesh.block_nodes[block];
        const auto own = bridge.mesh.nodes.middleCols(nodes.begin, nodes.size());
        CHECK((own.colwise() - corner).colwise().norm().minCoeff() < 1e-9);
        ++touching;
      }
  CHECK(touching > 1000);
}

TEST_CASE("Joints cover the whole length over which blocks touch", "[mesh]") {
  // Oracle: perimeter of all blocks = 2 x joints + outer boundary (base, sides, top, intrados chords and
  // legs).
  const Model bridge = bridge_with(true, 0);
  double perimeter = 0.0;
  for (const BoundaryEdge& edge : bridge.mesh.edges)
    perimeter += (bridge.mesh.position(edge.to) - bridge.mesh.position(edge.from)).norm();
  double joints = 0.0;
  for (const Joint& joint : bridge.joints) joints += joint.length;
  const double chords = 17 * 2.0 * 3.5 * std::sin(std::numbers::pi / 34);
  CHECK(perimeter - 2.0 * joints == Approx((20.0 - 7.0) + 2 * 6.0 + 20.0 + chords + 2 * 1.05).epsilon(1e-9));
}

TEST_CASE("Cutting between corners gives n - 2 triangles also round a reflex corner", "[mesh]") {
  const Polygon notched = {{0, 0}, {2, 0}, {2, 2}, {1, 0.5}, {0, 2}};
  const Triangulation cut = cut_between_corners(notched);
  REQUIRE(cut.triangles.size() == 3);
  double total = 0.0;
  for (const auto& t : cut.triangles) {
    const double part =
        area({notched[static_cast<std::size_t>(t[0])], notched[static_cast<std::size_t>(t[1])],
              notched[static_cast<std::size_t>(t[2])]});
    CHECK(part > 0.0);
    total += part;
  }
  CHECK(total == Approx(area(notched)));
}
