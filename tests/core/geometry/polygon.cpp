#include "core/geometry/polygon.h"

#include <algorithm>
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

TEST_CASE("Polygons that share an edge, or a part of one, are joined to the outline of both (by hand)",
          "[geometry]") {
  const Polygon square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const auto flush = joined(square, {{1, 0}, {2, 0}, {2, 1}, {1, 1}});
  REQUIRE(flush);
  CHECK(flush->size() == 4);  // corners on a straight line are gone
  CHECK(area(*flush) == Approx(2.0));
  const auto stepped = joined(square, {{1, 0.25}, {2, 0.25}, {2, 0.75}, {1, 0.75}});
  REQUIRE(stepped);
  CHECK(stepped->size() == 8);
  CHECK(area(*stepped) == Approx(1.5));
  const auto nearly = joined(square, {{1 + 1e-9, 0}, {2, 0}, {2, 1}, {1 - 1e-9, 1}});
  REQUIRE(nearly);
  CHECK(nearly->size() == 4);
}

TEST_CASE("Polygons that lie apart, touch at a corner or enclose a hole are not joined", "[geometry]") {
  const Polygon square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  CHECK_FALSE(joined(square, {{2, 0}, {3, 0}, {3, 1}, {2, 1}}));
  CHECK_FALSE(joined(square, {{1, 1}, {2, 1}, {2, 2}, {1, 2}}));
  const Polygon horseshoe = {{0, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 2}, {2, 2}, {2, 1}, {0, 1}};
  CHECK_FALSE(joined(horseshoe, {{-1, 0}, {0, 0}, {0, 3}, {-1, 3}}));
}

TEST_CASE("An outline that touches itself does so wherever its numbering begins", "[geometry]") {
  // The corner (0, 0) lies on the edge from (1, 0) to (-1, 0).
  Polygon outline = {{0.0, 1.0}, {0.0, 0.0}, {1.0, 0.0}, {-1.0, 0.0}, {-1.0, -1.0}, {2.0, -1.0}, {2.0, 1.0}};
  for (std::size_t turn = 0; turn < outline.size(); ++turn) {
    INFO("turned by " << turn);
    CHECK(self_crossing(outline).has_value());
    std::ranges::rotate(outline, outline.begin() + 1);
  }
  CHECK_FALSE(self_crossing({{0.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}, {1.0, 0.5}, {0.0, 1.0}}).has_value());
}
