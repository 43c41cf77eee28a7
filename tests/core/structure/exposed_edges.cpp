/// Upper faces of blocks. Oracle: their corners as they were drawn.

#include "core/structure/exposed_edges.h"

#include <catch2/catch.hpp>

using namespace voussoir;

namespace {

/// A stone 1 m long from x, whose upper corners are so high [m].
Block stone(double x, double left, double right, BlockRole role = BlockRole::wall) {
  Block block;
  block.role = role;
  block.polygon = {{x, 0.0}, {x + 1.0, 0.0}, {x + 1.0, right}, {x + 0.5, 0.5 * (left + right)}, {x, left}};
  return block;
}

bool is_seen(const Block& block) {
  return is_seen_from_above(block, {block});
}

}  // namespace

TEST_CASE("The upper face of a surveyed or a graded stone ends at its upper corners") {
  const auto [rise, is_top] = GENERATE(table<double, bool>(
      {{0.0, true}, {1e-8, true}, {-1e-3, true}, {0.05, true}, {-0.26, true}, {0.28, false}, {-1.0, false}}));
  const Block block = stone(2.0, 1.0, 1.0 + rise);
  CHECK(is_seen(block) == is_top);
  if (!is_top) return;
  const auto [left, right] = upper_face(block);
  CHECK(left == Point(2.0, 1.0));
  CHECK(right == Point(3.0, 1.0 + rise));
}

TEST_CASE("Backs of arch blocks are a top only where they are level") {
  CHECK(is_seen(stone(0.0, 1.0, 1.0, BlockRole::ring)));
  CHECK_FALSE(is_seen(stone(0.0, 1.0, 1.01, BlockRole::ring)));
}

TEST_CASE("What lies under another stone is no top, and a step is none of the face above it") {
  Block above = stone(0.4, 1.0, 1.0);
  for (Point& p : above.polygon) p.y() += 1.0;
  const Block below = stone(0.0, 1.0, 1.0);
  CHECK_FALSE(is_seen_from_above(below, {below, above}));
  CHECK(is_seen_from_above(above, {below, above}));

  Block step;
  step.polygon = {{0.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}, {1.0, 1.0}, {1.0, 2.0}, {0.0, 2.0}};
  const auto [left, right] = upper_face(step);
  CHECK(left == Point(0.0, 2.0));
  CHECK(right == Point(1.0, 2.0));
}
