/// @file Blocks as strangers draw them. Oracle: mistakes put into a sound assembly on purpose.

#include "core/structure/assembly_check.h"

#include <catch2/catch.hpp>

#include "core/error.h"
#include "core/geometry/facing_edges.h"
#include "core/geometry/overlap.h"
#include "tests/support/refusal.h"

using namespace voussoir;
using Catch::Matchers::Contains;

namespace {

/// Two courses of two blocks of 1 m x 0.5 m, far from the origin.
std::vector<Block> sound() {
  std::vector<Block> blocks;
  for (const double y : {7.0, 7.5})
    for (const double x : {100.0, 101.0}) {
      Block& block = blocks.emplace_back();
      block.label = "b" + std::to_string(blocks.size());
      block.polygon = {{x, y}, {x + 1.0, y}, {x + 1.0, y + 0.5}, {x, y + 0.5}};
    }
  return blocks;
}

std::string message(std::vector<Block> blocks) {
  return test::refusal_of([&] { heal_and_check(blocks, {}); });
}

void shift(Block& block, double x, double y) {
  for (Point& p : block.polygon) p += Point(x, y);
}

}  // namespace

TEST_CASE("A sound assembly is left as it is", "[assembly]") {
  std::vector<Block> blocks = sound();
  CHECK(heal_and_check(blocks, {}).empty());
  for (std::size_t i = 0; i < blocks.size(); ++i) CHECK(blocks[i].polygon == sound()[i].polygon);
}

TEST_CASE("Harmless mistakes are healed and said", "[assembly]") {
  std::vector<Block> blocks = sound();
  std::reverse(blocks[0].polygon.begin(), blocks[0].polygon.end());
  shift(blocks[3], 4e-4, -3e-4);
  blocks[2].polygon.push_back(blocks[2].polygon.front());
  const std::vector<std::string> notes = heal_and_check(blocks, {});
  REQUIRE(notes.size() == 2);
  CHECK_THAT(notes[0], Contains("turned 1"));
  CHECK_THAT(notes[1], Contains("moved") && Contains("0.5 mm"));  // 0.4 and 0.3 mm
  // Oracle: the blocks fill their common rectangle again, without gaps or overlaps.
  double sum = 0.0;
  Polygon all = {{100.0, 7.0}, {102.0, 7.0}, {102.0, 8.0}, {100.0, 8.0}};
  for (const Block& block : blocks) {
    CHECK(area(block.polygon) > 0.0);
    sum += area(block.polygon);
  }
  CHECK(sum == Approx(area(all)).epsilon(2e-3));
  for (std::size_t i = 0; i < blocks.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) CHECK(overlap_of(blocks[i].polygon, blocks[j].polygon).area < 1e-12);
  std::vector<Block> again = blocks;
  CHECK(heal_and_check(again, {}).empty());
}

TEST_CASE("A corner beside a long edge becomes a corner of it, and the joint has no gap", "[assembly]") {
  std::vector<Block> blocks = sound();
  blocks.pop_back();
  for (Point& p : blocks[2].polygon) p.x() += 0.4;  // stands astride the two below
  blocks[2].polygon[0].y() += 6e-4;
  blocks[2].polygon[1].y() -= 6e-4;
  const std::vector<std::string> notes = heal_and_check(blocks, {});
  REQUIRE(notes.size() == 1);
  CHECK_THAT(notes[0], Contains("0.6 mm"));
  double touching = 0.0;  // oracle: the length of the lower edge
  for (std::size_t b = 0; b < 2; ++b) {
    CHECK(overlap_of(blocks[b].polygon, blocks[2].polygon).area < 1e-12);
    const Polygon &upper = blocks[2].polygon, &lower = blocks[b].polygon;
    for (std::size_t i = 0; i < upper.size(); ++i)
      for (std::size_t j = 0; j < lower.size(); ++j)
        if (const auto stretch = facing_stretch({upper[i], upper[(i + 1) % upper.size()]},
                                                {lower[j], lower[(j + 1) % lower.size()]}, 1e-9))
          touching += stretch->length;
  }
  CHECK(touching == Approx(1.0).epsilon(1e-5));
  CHECK(heal_and_check(blocks, {}).empty());
}

TEST_CASE("A layer of a few millimetres fills the gap between the stones above and below it", "[assembly]") {
  std::vector<Block> blocks = sound();
  for (const std::size_t upper : {2, 3}) shift(blocks[upper], 0.0, 0.004);
  for (const double x : {100.0, 101.0}) {
    Block& layer = blocks.emplace_back();
    layer.label = "layer" + std::to_string(blocks.size());
    layer.polygon = {{x, 7.5}, {x + 1.0, 7.5}, {x + 1.0, 7.504}, {x, 7.504}};
  }
  CHECK(message(blocks) == "accepted");
  blocks.pop_back();
  CHECK_THAT(message(blocks), Contains("'b2' and 'b4' lie 4 mm apart"));
  blocks[4].polygon = {{100.0, 7.5}, {100.0005, 7.5}, {100.0005, 7.504}, {100.0, 7.504}};
  CHECK_THAT(message(blocks), Contains("'layer5'") && Contains("blocks_tolerance_m"));
}

TEST_CASE("Mistakes that change the bridge are refused with blocks and place", "[assembly]") {
  std::vector<Block> blocks = sound();
  shift(blocks[3], 0.0, -0.1);
  CHECK_THAT(message(blocks), Contains("'b2' and 'b4' overlap by 0.1 m2") && Contains("at (101.5, 7.45)"));
  blocks = sound();
  shift(blocks[3], 0.0, 0.004);
  CHECK_THAT(message(blocks), Contains("'b2' and 'b4' lie 4 mm apart") && Contains("along 1 m"));
  blocks = sound();
  shift(blocks[3], 0.5, 0.3);
  CHECK_THAT(message(blocks), Contains("'b4'") && Contains("is loose") && Contains("ground at y = 7"));
  blocks = sound();
  std::swap(blocks[0].polygon[0], blocks[0].polygon[1]);
  CHECK_THAT(message(blocks), Contains("'b1'"));
  blocks = sound();
  blocks[1].polygon = {{101.0, 7.0}, {102.0, 7.5}, {102.0, 7.0}, {101.0, 7.4}, {101.2, 7.5}};
  CHECK_THAT(message(blocks), Contains("'b2'") && Contains("crosses or touches itself at (101."));
  blocks = sound();
  blocks[1].label = "b1";
  CHECK_THAT(message(blocks), Contains("two blocks are called 'b1'"));
  blocks = sound();
  blocks[1].label = "b 2";
  CHECK_THAT(message(blocks), Contains("label 'b 2'"));
  blocks = sound();
  blocks[1].polygon.resize(2);
  CHECK_THAT(message(blocks), Contains("'b2' has 2 corners"));
  CHECK_THAT(message({}), Contains("no blocks"));
}

TEST_CASE("A gap wider than ten tolerances is meant", "[assembly]") {
  std::vector<Block> blocks = sound();
  shift(blocks[1], 0.011, 0.0);
  shift(blocks[3], 0.011, 0.0);
  CHECK(heal_and_check(blocks, {}).empty());
}

TEST_CASE("Blocks drawn in millimetres or centimetres are refused (a sound assembly, scaled)", "[assembly]") {
  for (const double scale : {100.0, 1000.0}) {
    std::vector<Block> blocks = sound();
    for (Block& block : blocks)
      for (Point& p : block.polygon) p *= scale;
    CHECK_THAT(message(blocks), Contains(fmt::format("the bridge is {:g} m long", 2.0 * scale)) &&
                                    Contains("are these millimetres?"));
  }
  std::vector<Block> blocks = sound();  // a slab as long as the bridge is no mistake
  blocks[0].polygon[1].x() = blocks[0].polygon[2].x() = 140.0;
  CHECK_NOTHROW(expect_metres(blocks));
}

TEST_CASE("Blocks laid by rules have to meet and to be carried as drawn ones have (gaps put in)",
          "[assembly]") {
  const auto refusal = [](double x, double y, const LaidTolerance& tolerance,
                          BlockRole role = BlockRole::wall) {
    std::vector<Block> blocks = sound();
    blocks[3].role = role;
    shift(blocks[3], x, y);
    return test::refusal_of(
        [&] { check_laid(blocks, tolerance, [](const Point& p) { return p.y() == 7.0; }); });
  };
  CHECK(refusal(0.0, 0.0, {}) == "accepted");
  CHECK_THAT(refusal(0.0, 5e-4, {}), Contains("'b2' and 'b4' lie 0.5 mm apart") &&
                                         Contains("touch within 0.001 mm or are more than 10 mm apart"));
  CHECK(refusal(0.0, 5e-4, {}, BlockRole::ring) == "accepted");  // b3's side holds b4
  CHECK_THAT(refusal(0.5, 0.3, {}), Contains("'b4'") && Contains("is loose"));
  CHECK_THAT(refusal(0.0, -1e-3, {}), Contains("overlap"));
}
