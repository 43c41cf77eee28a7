/// @file Arches of every shape. Oracles: closed forms of sectors, the rule of each ring, sums of areas.

#include "core/structure/arch.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <set>

#include "core/error.h"
#include "core/structure/model.h"
#include "tests/support/bridges.h"

using namespace voussoir;
using Catch::Matchers::Contains;

namespace {

constexpr bool kWall = true, kNoWall = false;

SpanDescription span_of(IntradosShape shape) {
  SpanDescription span{
      .centre_x = 10.0, .centre_y = 1.0, .ring_thickness = 0.4, .voussoirs = 15, .shape = shape};
  span.span = 6.0;
  span.rise = shape == IntradosShape::pointed ? 4.0 : 2.0;
  if (shape == IntradosShape::pointed) span.arc_radius = 1.5 + 16.0 / 6.0;
  if (shape == IntradosShape::three_centred) span.arc_radius = 1.2;
  if (shape == IntradosShape::points)
    span.points = {{7.0, 1.0}, {7.5, 2.0}, {8.5, 2.7}, {10.0, 3.0}, {11.5, 2.7}, {12.5, 2.0}, {13.0, 1.0}};
  return span;
}

const std::vector<IntradosShape> kShapes = {IntradosShape::semicircular, IntradosShape::segmental,
                                            IntradosShape::pointed,      IntradosShape::three_centred,
                                            IntradosShape::elliptic,     IntradosShape::points};

double ring_area(const Arch& arch) {
  double sum = 0.0;
  for (const Block& block : arch.blocks)
    if (block.kind != BlockKind::leg) sum += area(block.polygon);
  return sum;
}

}  // namespace

TEST_CASE("Voussoirs of a segment have the angle and the area of their sectors (closed form)", "[arch]") {
  SpanDescription span = span_of(IntradosShape::segmental);
  const Arch arch = make_arch(span, kWall);
  REQUIRE(arch.blocks.size() == 15);
  const double radius = (9.0 + 4.0) / 4.0;
  const double angle = 2.0 * std::asin(3.0 / radius) / 15.0;
  for (const Block& block : arch.blocks) {
    const Polygon& p = block.polygon;
    CHECK(area(p) ==
          Approx(0.5 * std::sin(angle) * ((radius + 0.4) * (radius + 0.4) - radius * radius)).epsilon(1e-12));
    const Point first = p[0] - p[1], last = p[3] - p[2];
    CHECK(std::acos(first.dot(last) / first.norm() / last.norm()) == Approx(angle).epsilon(1e-9));
  }
}

TEST_CASE("Joints of every shape are normal to the intrados and as long as the ring is thick", "[arch]") {
  constexpr double kStep = 1e-5;
  for (const IntradosShape shape : kShapes) {
    const SpanDescription span = span_of(shape);
    const Curve curve = intrados_of(span);
    const Arch arch = make_arch(span, kWall);
    int joint = 0;
    for (const Block& block : arch.blocks) {
      if (block.kind == BlockKind::leg) continue;
      const double at = double(joint++) / span.voussoirs;
      const Point along = block.polygon[0] - block.polygon[1];
      const Point tangent = curve.point({std::min(1.0, at + kStep), 1.0}, 0.0) -
                            curve.point({std::max(0.0, at - kStep), 1.0}, 0.0);
      INFO(int(shape) << " joint " << joint);
      CHECK(std::abs(along.normalized().dot(tangent.normalized())) < 1e-4);
      CHECK(along.norm() == Approx(0.4).epsilon(1e-12));
    }
    CHECK(joint == span.voussoirs);
  }
}

TEST_CASE("Several rings fill what lies between intrados and extrados, whatever their joints (areas)",
          "[arch]") {
  for (const IntradosShape shape : kShapes)
    for (const bool staggered : {false, true}) {
      SpanDescription span = span_of(shape);
      span.ring_thickness = 0.2;
      span.outer_rings = {{.thickness = 0.15, .voussoirs = 15, .staggered = staggered},
                          {.thickness = 0.25, .voussoirs = 22}};
      const Arch arch = make_arch(span, kWall);
      INFO(int(shape) << " staggered " << staggered);
      // Oracle: the outline of all rings, innermost joints below and outermost joints above.
      Polygon outline;
      const Curve curve = intrados_of(span);
      for (int j = 0; j <= 15; ++j) {
        outline.push_back(curve.point({double(j), 15.0}, 0.0));
        if (curve.has_corner && j == 7) outline.push_back(curve.point({1.0, 2.0}, 0.0));
      }
      for (int j = 22; j >= 0; --j) outline.push_back(curve.point({double(j), 22.0}, 0.6));
      CHECK(ring_area(arch) == Approx(area(outline)).epsilon(1e-12));
      std::set<int> rings;
      int in_second = 0;
      for (const Block& block : arch.blocks) {
        rings.insert(block.ring);
        in_second += block.ring == 1;
      }
      CHECK(rings == std::set<int>{0, 1, 2});
      CHECK(in_second == (staggered ? 16 : 15));
    }
}

TEST_CASE("Neighbouring rings share their edges: their joint is as long as the face between them", "[arch]") {
  BridgeDescription bridge;
  bridge.wall.courses = 0;
  SpanDescription span = span_of(IntradosShape::elliptic);
  span.outer_rings = {{.thickness = 0.3, .voussoirs = 22, .staggered = true}};
  bridge.spans = {span};
  const Model model = make_model(bridge);
  double found = 0.0;
  for (const Joint& joint : model.joints)
    if (model.layout[joint.first].ring != model.layout[joint.second].ring &&
        model.layout[joint.first].kind != BlockKind::leg && model.layout[joint.second].kind != BlockKind::leg)
      found += joint.length;
  // Oracle: chords between all joints of both rings.
  std::set<double> shares;
  for (int j = 0; j <= 15; ++j) shares.insert(j / 15.0);
  for (int j = 0; j <= 22; ++j) shares.insert(std::clamp((j - 0.5) / 22.0, 0.0, 1.0));
  shares.insert(1.0);
  const Curve curve = intrados_of(span);
  double expected = 0.0;
  for (auto at = shares.begin(), next = std::next(at); next != shares.end(); ++at, ++next)
    expected += (curve.point({*next, 1.0}, 0.4) - curve.point({*at, 1.0}, 0.4)).norm();
  CHECK(found == Approx(expected).epsilon(1e-9));
}

TEST_CASE("Arches of every symmetric shape make symmetric bridges, in a wall and alone", "[arch]") {
  for (const IntradosShape shape : kShapes)
    for (const int courses : {0, 12})
      for (const int voussoirs : {14, 15}) {
        BridgeDescription bridge;
        bridge.wall.courses = courses;
        bridge.wall.smallest_block = 0.1;
        bridge.spans = {span_of(shape)};
        bridge.spans.front().voussoirs = voussoirs;
        INFO(int(shape) << ", " << courses << " courses, " << voussoirs << " voussoirs");
        CHECK(make_model(bridge).symmetry.has_value());
      }
}

TEST_CASE("An intrados that leans is no mirror image of itself", "[arch]") {
  BridgeDescription bridge;
  bridge.spans = {span_of(IntradosShape::points)};
  bridge.spans.front().points[1].y() += 0.01;
  CHECK_FALSE(make_model(bridge).symmetry.has_value());
}

TEST_CASE("Wall, rings and opening fill the wall's rectangle, whatever the shape (areas)", "[arch]") {
  for (const IntradosShape shape : kShapes)
    for (const double skewback : {0.0, 0.5}) {
      BridgeDescription bridge;
      bridge.spans = {span_of(shape)};
      bridge.spans.front().skewback = skewback;
      double blocks = 0.0;
      for (const Block& block : lay_blocks(bridge).blocks) blocks += area(block.polygon);
      const Curve curve = intrados_of(bridge.spans.front());
      Polygon opening = {curve.point({1.0, 1.0}, 0.0), curve.point({0.0, 1.0}, 0.0)};
      opening.front().y() = opening.back().y() = 0.0;
      std::swap(opening.front(), opening.back());
      for (int j = 15; j >= 0; --j) {
        opening.push_back(curve.point({double(j), 15.0}, 0.0));
        if (curve.has_corner && j == 8) opening.push_back(curve.point({1.0, 2.0}, 0.0));
      }
      INFO(int(shape) << " skewback " << skewback);
      CHECK(blocks + area(opening) == Approx(20.0 * 6.0).epsilon(1e-9));
    }
}

TEST_CASE("A skewback reaches from the ring's last joint down to its foot", "[arch]") {
  SpanDescription span = span_of(IntradosShape::segmental);
  span.skewback = 0.3;
  const Arch arch = make_arch(span, kWall);
  REQUIRE(arch.blocks.size() == 17);
  const Polygon& stone = arch.blocks.front().polygon;
  const Curve curve = intrados_of(span);
  const Point inner = curve.point({0.0, 1.0}, 0.0), outer = curve.point({0.0, 1.0}, 0.4);
  CHECK(arch.blocks.front().kind == BlockKind::leg);
  const double width = inner.x() - outer.x();
  CHECK(area(stone) == Approx(width * 0.3 + 0.5 * width * (outer.y() - inner.y())).epsilon(1e-12));
}

TEST_CASE("A ring alone stands on stones down to the ground; in a wall the courses carry it", "[arch]") {
  const SpanDescription span = span_of(IntradosShape::segmental);
  CHECK(make_arch(span, kWall).blocks.size() == 15);
  const Arch alone = make_arch(span, kNoWall);
  REQUIRE(alone.blocks.size() == 17);
  for (const Block* stone : {&alone.blocks.front(), &alone.blocks.back()}) {
    double lowest = 1.0;
    for (const Point& p : stone->polygon) lowest = std::min(lowest, p.y());
    CHECK(lowest == 0.0);
  }
}

TEST_CASE("Only the ends on the intrados are control points, each block's from left to right", "[arch]") {
  BridgeDescription bridge;
  bridge.spans = {span_of(IntradosShape::pointed)};
  bridge.spans.front().outer_rings = {{.thickness = 0.3, .voussoirs = 21}};
  const Model model = make_model(bridge);
  const Curve curve = intrados_of(bridge.spans.front());
  int arch_points = 0;
  for (const ControlPoint& point : model.control_points) {
    if (point.name.front() != 'A') continue;
    const int joint = (arch_points + 1) / 2;  // A1 is joint 0, A2 and A3 are joint 1..
    CHECK((point.position - curve.point({double(joint), 15.0}, 0.0)).norm() < 1e-12);
    ++arch_points;
  }
  CHECK(arch_points == 30);
}

TEST_CASE("Rings that are too thick for a hollow of a surveyed intrados are refused", "[arch]") {
  SpanDescription span = span_of(IntradosShape::points);
  span.points = {{7.0, 1.0}, {8.0, 2.5}, {9.0, 3.0}, {10.0, 2.0}, {11.0, 3.0}, {12.0, 2.5}, {13.0, 1.0}};
  span.ring_thickness = 1.5;
  CHECK_THROWS_WITH(make_arch(span, kWall), Contains("turned inside out") && Contains("voussoir"));
}
