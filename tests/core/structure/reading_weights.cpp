#include "core/structure/reading_weights.h"

#include <catch2/catch.hpp>

#include "tests/support/made_up_database.h"

using namespace voussoir;

namespace {

const Model& small_bridge() {
  static const Model bridge = make_model(test::small_bridge_file().description);
  return bridge;
}

/// Displacements that are a linear function of the place: the first column at the origin, then the gradient.
Field linear_field(const Point& shift, const Eigen::Matrix2d& gradient) {
  return (gradient * small_bridge().mesh.nodes).colwise() + shift;
}

BlockId block(const char* name) {
  return parse_scene(name, small_bridge().layout).removed.front();
}

const Point kShift(3e-3, -2e-3);
const Eigen::Matrix2d kGradient = (Eigen::Matrix2d() << 1e-4, -3e-4, 5e-4, 2e-4).finished();

}  // namespace

// Tolerances: sums of fewer than ten products of numbers of 1e-3 with shares below 10 lose at most some
// 1e-17.

TEST_CASE(
    "A displacement is exact in a linear field, for every triangle's centroid (linear shape functions)") {
  const Mesh& mesh = small_bridge().mesh;
  const Field field = linear_field(kShift, kGradient);
  for (std::size_t id = 0; id < mesh.block_triangles.size(); ++id)
    for (int t = mesh.block_triangles[id].begin; t < mesh.block_triangles[id].end; ++t) {
      Point at = Point::Zero();
      for (const NodeId node : mesh.triangles[static_cast<std::size_t>(t)].nodes)
        at += mesh.position(node) / 3.0;
      const Place place{at, BlockId{static_cast<std::int32_t>(id)}};
      const Point expected = kShift + kGradient * at;
      CHECK(weighted_sum(displacement_weights(place, Point(1, 0), mesh), field) ==
            Approx(expected.x()).margin(1e-16));
      CHECK(weighted_sum(displacement_weights(place, Point(0, 1), mesh), field) ==
            Approx(expected.y()).margin(1e-16));
      for (const NodeWeight& part : displacement_weights(place, Point(0, 1), mesh))
        CHECK(part.weight.y() == Approx(1.0 / 3.0).epsilon(1e-9));  // of its own triangle, not another's
    }
}

TEST_CASE("A tilt is the angle of a small rotation about any centre, counter-clockwise (closed form)") {
  const Mesh& mesh = small_bridge().mesh;
  const double angle = 2e-4;
  const Field field = linear_field(kShift, (Eigen::Matrix2d() << 0, -angle, angle, 0).finished());
  for (std::size_t id = 0; id < mesh.block_nodes.size(); ++id)
    CHECK(weighted_sum(rotation_weights(BlockId{static_cast<std::int32_t>(id)}, mesh), field) ==
          Approx(angle).epsilon(1e-12));
}

TEST_CASE("A uniform stretch tilts a rectangular block by nothing (symmetry)") {
  const Field field = linear_field(kShift, (Eigen::Matrix2d() << 1e-3, 0, 0, -1e-3).finished());
  CHECK(weighted_sum(rotation_weights(block("2,1"), small_bridge().mesh), field) ==
        Approx(0.0).margin(1e-16));
}

TEST_CASE(
    "A distance becomes longer by its length times the strain along it, whatever rotates (closed form)") {
  const Mesh& mesh = small_bridge().mesh;
  const Place from{{0.25, 0.6}, block("2,1")};
  const Place to{{0.75, 0.9}, block("2,1")};
  const Point way = to.position - from.position;
  const Field stretched = linear_field(kShift, kGradient);
  CHECK(weighted_sum(distance_weights(from, to, mesh), stretched) ==
        Approx(way.dot(kGradient * way) / way.norm()).epsilon(1e-12));
  CHECK(weighted_sum(distance_weights(to, from, mesh), stretched) ==
        Approx(weighted_sum(distance_weights(from, to, mesh), stretched)).epsilon(1e-12));
  const Field turned = linear_field(kShift, (Eigen::Matrix2d() << 0, -2e-4, 2e-4, 0).finished());
  CHECK(weighted_sum(distance_weights(from, to, mesh), turned) == Approx(0.0).margin(1e-16));
}

TEST_CASE("A sensor on a block that is gone shows nothing", "[sensors]") {
  Field field = linear_field(kShift, kGradient);
  const IndexRange gone = small_bridge().mesh.block_nodes[static_cast<std::size_t>(value(block("2,1")))];
  field.middleCols(gone.begin, gone.size()).setConstant(std::nan(""));
  const Place from{{0.5, 0.75}, block("2,1")};
  const Place to{{0.5, 1.25}, block("3,1")};
  CHECK(std::isnan(weighted_sum(distance_weights(from, to, small_bridge().mesh), field)));
  CHECK(std::isnan(weighted_sum(rotation_weights(block("2,1"), small_bridge().mesh), field)));
  CHECK_FALSE(std::isnan(weighted_sum(rotation_weights(block("3,1"), small_bridge().mesh), field)));
}
