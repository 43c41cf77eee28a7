#include "core/structure/block_layout.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"

namespace voussoir {
namespace {

/// Joint j of a ring with n voussoirs (j = 0 at the left springing) at the given radius. Written so that
/// joints j and n - j are exact mirror images.
Point ring_point(const SpanDescription& span, double radius, int j) {
  const int n = span.voussoirs;
  const bool right = 2 * j > n;
  const double angle = std::numbers::pi * (right ? n - j : j) / n;  // from the nearer springing
  const double offset = radius * std::cos(angle);
  return {span.centre_x + (right ? offset : -offset), span.centre_y + radius * std::sin(angle)};
}

void add_ring(const SpanDescription& span, int ring, std::vector<Block>& blocks) {
  const double inner = span.intrados_radius;
  const double outer = span.extrados_radius();
  const auto ring_block = [ring](BlockKind kind) {
    Block block;
    block.role = BlockRole::ring;
    block.ring = ring;
    block.kind = kind;
    return block;
  };
  const auto leg = [&](double left, double right) {
    Block block = ring_block(BlockKind::leg);
    block.polygon = {{left, 0.0}, {right, 0.0}, {right, span.centre_y}, {left, span.centre_y}};
    return block;
  };
  if (span.centre_y > 0.0) blocks.push_back(leg(span.centre_x - outer, span.centre_x - inner));
  for (int j = 0; j < span.voussoirs; ++j) {
    Block block = ring_block(BlockKind::voussoir);
    block.polygon = {ring_point(span, outer, j), ring_point(span, inner, j), ring_point(span, inner, j + 1),
                     ring_point(span, outer, j + 1)};
    blocks.push_back(block);
  }
  if (span.centre_y > 0.0) blocks.push_back(leg(span.centre_x + inner, span.centre_x + outer));
}

/// What a ring and its opening occupy: legs and extrados chords.
Polygon enclosed_by_extrados(const SpanDescription& span) {
  const double outer = span.extrados_radius();
  Polygon polygon;
  if (span.centre_y > 0.0) {
    polygon.emplace_back(span.centre_x - outer, 0.0);
    polygon.emplace_back(span.centre_x + outer, 0.0);
  }
  for (int j = span.voussoirs; j >= 0; --j) polygon.push_back(ring_point(span, outer, j));
  return polygon;
}

/// x of the vertical joints of a course, from 0 to the wall's length.
std::vector<double> joints_of_course(const WallDescription& wall, int course) {
  const bool shifted = wall.bond == Bond::running && course % 2 == 1;
  const double first = shifted ? 0.5 * wall.block_length : wall.block_length;
  std::vector<double> x = {0.0};
  for (int i = 0; first + i * wall.block_length < wall.length - 1e-9 * wall.block_length; ++i)
    x.push_back(first + i * wall.block_length);
  x.push_back(wall.length);
  return x;
}

std::vector<Polygon> cut_by_spans(const Polygon& rectangle, const BridgeDescription& description) {
  std::vector<Polygon> parts = {rectangle};
  for (const SpanDescription& span : description.spans) {
    if (rectangle[1].x() <= span.centre_x - span.extrados_radius() ||
        rectangle[0].x() >= span.centre_x + span.extrados_radius())
      continue;  // beside the span
    std::vector<Polygon> remaining;
    for (const Polygon& part : parts)
      for (Polygon& piece : subtract(part, enclosed_by_extrados(span), description.wall.smallest_piece))
        remaining.push_back(std::move(piece));
    parts = std::move(remaining);
  }
  return parts;
}

void add_course(const BridgeDescription& description, int course, std::vector<Block>& blocks) {
  const double bottom = (course - 1) * description.wall.course_height;
  const double top = course * description.wall.course_height;
  const std::vector<double> x = joints_of_course(description.wall, course);
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    const Polygon rectangle = {{x[i], bottom}, {x[i + 1], bottom}, {x[i + 1], top}, {x[i], top}};
    for (const Polygon& part : cut_by_spans(rectangle, description)) {
      const bool whole = std::abs(area(part) - area(rectangle)) <= 1e-9 * area(rectangle);
      Block& block = blocks.emplace_back();
      block.index = {course, static_cast<int>(blocks.size())};  // numbered course by course in the end
      block.kind = whole ? BlockKind::plain : BlockKind::cut;
      block.top_course = course == description.wall.courses;
      block.polygon = whole ? rectangle : part;
    }
  }
}

/// Numbers the blocks of every course from the left, and calls them by that.
void number(std::vector<Block>& blocks) {
  BlockIndex last;
  for (Block& block : blocks) {
    last = {block.index.course, block.index.course == last.course ? last.position + 1 : 1};
    block.index = last;
    block.label = to_string(last);
  }
}

template <class Condition>
std::optional<BlockId> first_block(const std::vector<Block>& blocks, Condition condition) {
  const auto found = std::find_if(blocks.begin(), blocks.end(), condition);
  if (found == blocks.end()) return std::nullopt;
  return BlockId{static_cast<std::int32_t>(found - blocks.begin())};
}

}  // namespace

std::string to_string(BlockIndex index) {
  return fmt::format("{},{}", index.course, index.position);
}

std::optional<BlockId> BlockLayout::find(BlockIndex index) const {
  return first_block(blocks, [&](const Block& b) { return b.index == index; });
}

std::optional<BlockId> BlockLayout::find_label(std::string_view label) const {
  return first_block(blocks, [&](const Block& b) { return b.label == label; });
}

int BlockLayout::count_with(BlockRole role) const {
  return static_cast<int>(
      std::count_if(blocks.begin(), blocks.end(), [&](const Block& b) { return b.role == role; }));
}

int BlockLayout::count_in_course(int course) const {
  return static_cast<int>(
      std::count_if(blocks.begin(), blocks.end(), [&](const Block& b) { return b.index.course == course; }));
}

BlockLayout lay_blocks(const BridgeDescription& description) {
  BlockLayout layout;
  for (std::size_t i = 0; i < description.spans.size(); ++i)
    add_ring(description.spans[i], static_cast<int>(i), layout.blocks);
  std::stable_sort(layout.blocks.begin(), layout.blocks.end(), [](const Block& a, const Block& b) {
    return centroid(a.polygon).x() < centroid(b.polygon).x();
  });
  for (Block& block : layout.blocks) block.index.course = 0;
  for (int course = 1; course <= description.wall.courses; ++course)
    add_course(description, course, layout.blocks);
  const WallDescription& wall = description.wall;
  layout.small_pieces =
      join_small_pieces(layout.blocks, wall.smallest_block * wall.course_height * wall.block_length,
                        description.joint_tolerance);
  number(layout.blocks);
  if (layout.blocks.empty()) throw InputError("the bridge has no blocks: give it courses or spans");
  return layout;
}

}  // namespace voussoir
