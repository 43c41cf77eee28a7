#include "core/geometry/polygon.h"

#include <catch2/catch.hpp>
#include <numbers>

using namespace voussoir;

namespace {
const Polygon kUnitSquare = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
}

TEST_CASE("Area and centroid of a triangle have their closed forms", "[geometry]") {
  const Polygon triangle = {{0, 0}, {3, 0}, {0, 6}};
  CHECK(area(triangle) == Approx(9.0));
  CHECK(centroid(triangle).isApprox(Point(1.0, 2.0)));
}

TEST_CASE("Area and centroid keep their digits a million metres from the origin", "[geometry]") {
  Polygon far = kUnitSquare;
  for (Point& p : far) p += Point(1e6, 1e6);
  CHECK(area(far) == Approx(1.0).epsilon(1e-12));
  CHECK((centroid(far) - Point(1e6 + 0.5, 1e6 + 0.5)).norm() < 1e-9);
}

TEST_CASE("A mirrored polygon has the same area and is counter-clockwise", "[geometry]") {
  CHECK(area(mirrored({{0, 0}, {3, 0}, {0, 6}}, 1.7)) == Approx(9.0));
}

TEST_CASE("A strip across a square cuts it into two parts, left one first", "[geometry]") {
  const auto parts = subtract(kUnitSquare, {{0.25, -1}, {0.5, -1}, {0.5, 2}, {0.25, 2}}, 1e-9);
  REQUIRE(parts.size() == 2);
  CHECK(area(parts[0]) == Approx(0.25));
  CHECK(area(parts[1]) == Approx(0.5));
}

TEST_CASE("Parts smaller than the smallest piece vanish", "[geometry]") {
  CHECK(subtract(kUnitSquare, {{-1, -1}, {2, -1}, {2, 0.999}, {-1, 0.999}}, 0.01).empty());
  CHECK(subtract(kUnitSquare, {{-1, -1}, {2, -1}, {2, 0.999}, {-1, 0.999}}, 0.0001).size() == 1);
}

TEST_CASE("Subtracting keeps coordinates to round-off", "[geometry]") {
  const auto parts = subtract(kUnitSquare, {{0.3, -1}, {2, -1}, {2, 2}, {0.3, 2}}, 1e-9);
  REQUIRE(parts.size() == 1);
  CHECK(std::abs(area(parts[0]) - 0.3) < 1e-15);
}
