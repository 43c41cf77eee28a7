#include "core/structure/control_point.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/support/bridges.h"

using namespace voussoir;

namespace {

/// Oracle: the reference bridge's description as numbers. 20 m by 6 m, top course of 20 blocks of 1 m; the
/// opening is 7 m wide about x = 10, straight up to 1.05 m, above it a semicircle of 17 equal angles.
struct Expected {
  std::string name;
  std::string block;
  Point position;
};

/// Place on the intrados after `joint` of the 17 equal angles, counted from the left springing.
Point on_semicircle(int joint) {
  const double angle = std::numbers::pi * (1.0 - joint / 17.0);
  return Point(10.0, 1.05) + 3.5 * Point(std::cos(angle), std::sin(angle));
}

std::vector<Expected> upper_corners() {
  std::vector<Expected> points;
  for (int block = 1; block <= 20; ++block)
    for (const int corner : {0, 1})
      points.push_back({"T" + std::to_string(2 * block - 1 + corner), "12," + std::to_string(block),
                        Point(block - 1.0 + corner, 6.0)});
  return points;
}

/// Up the left leg, round the semicircle, down the right leg.
std::vector<Expected> intrados_corners() {
  std::vector<Expected> points = {{"A1", "0,1", Point(6.5, 0.0)}, {"A2", "0,1", Point(6.5, 1.05)}};
  for (int voussoir = 1; voussoir <= 17; ++voussoir)
    for (const int corner : {0, 1})
      points.push_back({"A" + std::to_string(2 * voussoir + 1 + corner), "0," + std::to_string(voussoir + 1),
                        on_semicircle(voussoir - 1 + corner)});
  points.push_back({"A37", "0,19", Point(13.5, 1.05)});
  points.push_back({"A38", "0,19", Point(13.5, 0.0)});
  return points;
}

}  // namespace

TEST_CASE("The reference bridge's 78 points have the names, blocks and places of its closed geometry",
          "[control-points]") {
  const Model bridge = test::reference_bridge();
  std::vector<Expected> expected = upper_corners();
  for (const Expected& point : intrados_corners()) expected.push_back(point);
  REQUIRE(expected.size() == 78);
  REQUIRE(bridge.control_points.size() == 78);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const ControlPoint& point = bridge.control_points[i];
    INFO(expected[i].name);
    CHECK(point.name == expected[i].name);
    CHECK(to_string(Scene{{point.block}}, bridge.layout) == expected[i].block);
    CHECK((point.position - expected[i].position).norm() < 1e-12);
    CHECK((bridge.mesh.position(point.node) - expected[i].position).norm() < 1e-12);
    const IndexRange own = bridge.mesh.block_nodes[static_cast<std::size_t>(value(point.block))];
    CHECK(own.contains(value(point.node)));
  }
}

TEST_CASE("Points of a bridge of two spans are mirror images of each other, last to first (symmetry)",
          "[control-points]") {
  const BridgeDescription description = read_bridge_file(test::example_bridge("two-span")).description;
  const Model bridge = make_model(description);
  const double length = description.wall.length;
  const auto family = [&](char letter) {
    std::vector<Point> places;
    for (const ControlPoint& point : bridge.control_points)
      if (point.name[0] == letter) places.push_back(point.position);
    return places;
  };
  for (const char letter : {'T', 'A'}) {
    const std::vector<Point> places = family(letter);
    REQUIRE(places.size() == (letter == 'T' ? 28 : 60));  // 14 blocks on top, 30 in the arches
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Point& image = places[places.size() - 1 - i];
      INFO(letter << i + 1);
      CHECK((Point(length - image.x(), image.y()) - places[i]).norm() < 1e-9);
    }
  }
}

TEST_CASE("Points on the face are the middles of the wall's blocks and read them exactly (closed form)",
          "[control-points]") {
  BridgeDescription description = read_bridge_file(test::example_bridge("reference")).description;
  description.control_points = {.top = false, .arch = false, .face = true};
  const Model bridge = make_model(description);
  REQUIRE(bridge.control_points.size() == 193);  // 212 blocks without the arch's 19
  const Eigen::Vector2d slope(3e-4, -2e-4);
  Field field = Field::Zero(2, bridge.mesh.node_count());
  field.row(1) = 1e-3 + (slope.transpose() * bridge.mesh.nodes).array();
  const Eigen::VectorXd read = readings_at(bridge.control_points, field);
  std::size_t next = 0;
  for (std::size_t b = 0; b < bridge.layout.size(); ++b) {
    const Block& block = bridge.layout.blocks[b];
    if (block.role == BlockRole::ring) continue;
    const ControlPoint& point = bridge.control_points[next];
    CHECK(point.name == fmt::format("F{}", next + 1));
    CHECK(static_cast<std::size_t>(value(point.block)) == b);
    CHECK(read[static_cast<Eigen::Index>(next)] ==
          Approx(1e-3 + slope.dot(centroid(block.polygon))).epsilon(1e-12));
    ++next;
  }
}

TEST_CASE("Vertical displacements are those of the points' nodes, in the points' order (written out)",
          "[control-points]") {
  const Model bridge = test::small_bridge();
  Field field(2, bridge.mesh.node_count());
  for (Eigen::Index node = 0; node < field.cols(); ++node)
    field.col(node) << 0.5, -bridge.mesh.nodes(0, node) - 100.0 * bridge.mesh.nodes(1, node);
  const Eigen::VectorXd d = readings_at(bridge.control_points, field);
  REQUIRE(d.size() == static_cast<Eigen::Index>(bridge.control_points.size()));
  for (Eigen::Index i = 0; i < d.size(); ++i) {
    const Point& place = bridge.control_points[static_cast<std::size_t>(i)].position;
    CHECK(d[i] == Approx(-place.x() - 100.0 * place.y()).epsilon(1e-12));
  }
}
