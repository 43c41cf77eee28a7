#include "core/structure/small_pieces.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <random>

#include "core/error.h"
#include "core/structure/model.h"

using namespace voussoir;

namespace {

double smallest_share(const BlockLayout& layout, const WallDescription& wall) {
  double least = 1.0;
  for (const Block& block : layout.blocks)
    if (block.role == BlockRole::wall)
      least = std::min(least, area(block.polygon) / (wall.course_height * wall.block_length));
  return least;
}

double total_area(const BlockLayout& layout) {
  return std::accumulate(layout.blocks.begin(), layout.blocks.end(), 0.0,
                         [](double sum, const Block& block) { return sum + area(block.polygon); });
}

}  // namespace

TEST_CASE("The rest of a course below a tenth of a block stays at the last block (by hand)", "[layout]") {
  BridgeDescription bridge;
  bridge.spans.clear();
  bridge.wall = {.length = 3.05,
                 .courses = 2,
                 .course_height = 0.5,
                 .block_length = 1.0,
                 .bond = Bond::stack,
                 .smallest_block = 0.1};
  const BlockLayout layout = lay_blocks(bridge);
  CHECK(layout.small_pieces == SmallPieces{2, 0});
  CHECK(layout.last_position(1) == 3);
  const Block& last = layout[*layout.find({2, 3})];
  CHECK(area(last.polygon) == Approx(0.5 * 1.05));
  CHECK(last.polygon.size() == 4);
  CHECK(last.top_course);
}

TEST_CASE("The reference bridge's pieces over the crown are joined if its file says so", "[layout]") {
  BridgeDescription bridge;
  const BlockLayout as_published = lay_blocks(bridge);
  CHECK(as_published.small_pieces == SmallPieces{});
  bridge.wall.smallest_block = kSmallestBlock;
  const BlockLayout layout = lay_blocks(bridge);
  CHECK(layout.small_pieces.joined > 0);
  CHECK(layout.size() + static_cast<std::size_t>(layout.small_pieces.joined) == as_published.size());
  CHECK(total_area(layout) == Approx(total_area(as_published)).epsilon(1e-12));
  CHECK(make_model(bridge).symmetry.has_value());
}

TEST_CASE("Of random bridges nothing is lost, no piece with a neighbour stays small, labels count through",
          "[layout]") {
  std::mt19937 random(3);
  const auto between = [&](double least, double most) {
    return least + (most - least) * static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
  };
  int joined_pieces = 0;
  for (int i = 0; i < 200; ++i) {
    BridgeDescription bridge;
    SpanDescription& span = bridge.spans.front();
    span = {.centre_x = 0.0,
            .centre_y = between(0.0, 1.5),
            .intrados_radius = between(1.0, 5.0),
            .ring_thickness = 0.0,
            .voussoirs = 9 + 2 * static_cast<int>(between(0.0, 16.9))};
    span.ring_thickness = between(0.08, 0.25) * span.intrados_radius;
    bridge.wall = {.length = 2.0 * span.extrados_radius() + between(1.0, 4.0),
                   .courses = 1 + static_cast<int>(between(1.0, 14.0)),
                   .course_height = between(0.2, 0.6),
                   .block_length = between(0.4, 1.5),
                   .bond = i % 2 == 0 ? Bond::running : Bond::stack,
                   .smallest_block = 0.1};
    span.centre_x = 0.5 * bridge.wall.length;
    const BlockLayout layout = lay_blocks(bridge);
    BridgeDescription as_cut = bridge;
    as_cut.wall.smallest_block = 0.0;
    INFO("bridge " << i);
    CHECK(total_area(layout) == Approx(total_area(lay_blocks(as_cut))).epsilon(1e-9));
    if (layout.small_pieces.left == 0) CHECK(smallest_share(layout, bridge.wall) >= 0.1 - 1e-12);
    for (int course = 1; course <= bridge.wall.courses; ++course)
      for (int position = 1; position <= layout.last_position(course); ++position)
        CHECK(layout.find({course, position}));
    joined_pieces += layout.small_pieces.joined;
    CHECK_NOTHROW(make_model(bridge));
  }
  CHECK(joined_pieces > 200);
}
