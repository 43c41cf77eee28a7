#include "core/geometry/facing_edges.h"

#include <catch2/catch.hpp>

using namespace voussoir;

TEST_CASE("Two edges share the stretch where they run against each other (by hand)", "[geometry]") {
  const auto stretch = facing_stretch({{0, 0}, {4, 0}}, {{5, 0}, {1, 0}}, 1e-6);
  REQUIRE(stretch);
  CHECK(stretch->length == Approx(3.0));
  CHECK(stretch->on_first == std::array{0.25, 1.0});
  CHECK(stretch->on_second[0] == Approx(1.0));
  CHECK(stretch->on_second[1] == Approx(0.25));
}

TEST_CASE("Edges share nothing that run the same way, lie apart, or only touch", "[geometry]") {
  CHECK_FALSE(facing_stretch({{0, 0}, {4, 0}}, {{1, 0}, {5, 0}}, 1e-6));
  CHECK_FALSE(facing_stretch({{0, 0}, {4, 0}}, {{5, 1e-5}, {1, 1e-5}}, 1e-6));
  CHECK_FALSE(facing_stretch({{0, 0}, {4, 0}}, {{5, 0}, {4, 0}}, 1e-6));
  CHECK(facing_stretch({{0, 0}, {4, 0}}, {{5, 1e-7}, {1, 1e-7}}, 1e-6));
}
