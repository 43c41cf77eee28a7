#include "core/structure/block_layout.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/error.h"
#include "core/structure/arch.h"
#include "core/structure/assembly_check.h"
#include "core/structure/block_boxes.h"
#include "core/structure/exposed_edges.h"
#include "core/structure/separate_rings.h"

namespace voussoir {
namespace {

/// An arch's outline and how far it reaches.
struct ArchOpening {
  Polygon enclosed;
  Box box;
};

/// The rings of all spans, ring by ring from the intrados outwards, each from left to right. Returns what the
/// arches leave free.
std::vector<ArchOpening> add_arches(const BridgeDescription& description, std::vector<Block>& blocks) {
  std::vector<ArchOpening> openings;
  std::vector<std::pair<int, double>> order;  // layer, x
  int rings = 0;
  for (const SpanDescription& span : description.spans) {
    Arch arch = make_arch(span, description.wall.courses > 0);
    for (Block& block : arch.blocks) {
      order.emplace_back(block.ring, centroid(block.polygon).x());
      block.ring += rings;
      block.index = {0, static_cast<int>(blocks.size())};
      blocks.push_back(std::move(block));
    }
    rings += ring_count(span);
    openings.push_back({arch.enclosed, box_of(arch.enclosed)});
  }
  const auto place = [&](const Block& block) {
    return order[static_cast<std::size_t>(block.index.position)];
  };
  std::stable_sort(blocks.begin(), blocks.end(),
                   [&](const Block& a, const Block& b) { return place(a) < place(b); });
  return openings;
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

std::vector<Polygon> cut_by_arches(const Polygon& rectangle, const std::vector<ArchOpening>& openings,
                                   double smallest_piece) {
  std::vector<Polygon> parts = {rectangle};
  for (const ArchOpening& opening : openings) {
    const bool beside =
        rectangle[1].x() <= opening.box.min().x() || rectangle[0].x() >= opening.box.max().x();
    if (beside) continue;
    std::vector<Polygon> remaining;
    for (const Polygon& part : parts)
      for (Polygon& piece : subtract(part, opening.enclosed, smallest_piece))
        remaining.push_back(std::move(piece));
    parts = std::move(remaining);
  }
  return parts;
}

void add_course(const WallPart& part, int course, const std::vector<ArchOpening>& openings,
                std::vector<Block>& blocks) {
  const WallDescription& wall = part.courses;
  const double bottom = part.base_y + (course - 1) * wall.course_height;
  const double top = part.base_y + course * wall.course_height;
  std::vector<double> x = joints_of_course(wall, course);
  for (double& joint : x) joint += part.from_x;
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    const Polygon rectangle = {{x[i], bottom}, {x[i + 1], bottom}, {x[i + 1], top}, {x[i], top}};
    for (const Polygon& piece : cut_by_arches(rectangle, openings, wall.smallest_piece)) {
      const bool whole = std::abs(area(piece) - area(rectangle)) <= 1e-9 * area(rectangle);
      Block& block = blocks.emplace_back();
      block.role = part.role;
      block.index = {course, static_cast<int>(blocks.size())};  // numbered course by course in the end
      block.kind = whole ? BlockKind::plain : BlockKind::cut;
      block.top_course = course == wall.courses;
      block.polygon = whole ? rectangle : piece;
    }
  }
}

/// The wall or another part, behind the blocks that are there, its courses counted on from `courses_before`.
SmallPieces add_part(const WallPart& part, int courses_before, const std::vector<ArchOpening>& openings,
                     double tolerance, std::vector<Block>& blocks) {
  const WallDescription& wall = part.courses;
  std::vector<Block> laid;
  for (int course = 1; course <= wall.courses; ++course) add_course(part, course, openings, laid);
  const SmallPieces result =
      join_small_pieces(laid, wall.smallest_block * wall.course_height * wall.block_length, tolerance);
  for (Block& block : laid) block.index.course += courses_before;
  std::move(laid.begin(), laid.end(), std::back_inserter(blocks));
  return result;
}

/// Of a bridge with further parts the top is whatever is seen from above.
void mark_top(std::vector<Block>& blocks) {
  for (Block& block : blocks) block.top_course = is_seen_from_above(block, blocks);
}

/// Parts have to meet each other and the wall. Gaps count as mistakes where they are narrower than half a
/// course.
void check_parts(const BridgeDescription& description, const std::vector<Block>& blocks) {
  LaidTolerance tolerance{.joint = description.joint_tolerance};
  std::vector<WallDescription> laid = {description.wall};
  for (const WallPart& part : description.parts) laid.push_back(part.courses);
  for (const WallDescription& courses : laid)
    tolerance.gap = std::min(tolerance.gap, 0.5 * courses.course_height);
  const SupportDescription& supports = description.supports;
  const auto near = [&](double a, double b) { return std::abs(a - b) <= tolerance.joint; };
  check_laid(blocks, tolerance, [&](const Point& p) {
    return near(p.y(), 0.0) || supports.top != SupportKind::free ||
           (supports.sides == SupportKind::clamped &&
            (near(p.x(), 0.0) || near(p.x(), description.wall.length)));
  });
}

/// Blocks given one by one keep their labels. An arch block's open face towards the middle of its ring's
/// blocks and the ground below counts as its intrados.
BlockLayout given_blocks(const BridgeDescription& description) {
  BlockLayout layout{.blocks = description.blocks};
  separate_rings(description.joint_tolerance, layout.blocks);
  const std::map<int, Box> rings = boxes_of_rings(layout.blocks);
  const double ground = bounds_of(description).corner.y();
  for (Block& block : layout.blocks) {
    const Point middle(rings.at(block.ring).center().x(), ground);
    if (block.role == BlockRole::ring)
      block.intrados = open_face_towards(block, layout.blocks, middle, description.joint_tolerance);
    block.top_course = is_seen_from_above(block, layout.blocks);
  }
  return layout;
}

template <class Condition>
std::optional<BlockId> first_block(const std::vector<Block>& blocks, Condition condition) {
  const auto found = std::find_if(blocks.begin(), blocks.end(), condition);
  if (found == blocks.end()) return std::nullopt;
  return BlockId{static_cast<std::int32_t>(found - blocks.begin())};
}

}  // namespace

std::optional<BlockId> BlockLayout::find(BlockIndex index) const {
  return first_block(blocks, [&](const Block& b) { return b.index == index; });
}

std::optional<BlockId> BlockLayout::find_label(std::string_view label) const {
  return first_block(blocks, [&](const Block& b) { return b.label == label; });
}

void BlockLayout::expect(const std::string& where, const std::vector<std::string>& names,
                         const std::vector<std::string>& missing) const {
  for (const std::string& name : names)
    if (!find_role(name) && !find_label(name) && std::ranges::find(missing, name) == missing.end())
      throw InputError(fmt::format("{}: '{}' is no block: expected the label of a block or a role ({})",
                                   where, name, role_names()));
}

int BlockLayout::count_with(BlockRole role) const {
  return static_cast<int>(
      std::count_if(blocks.begin(), blocks.end(), [&](const Block& b) { return b.role == role; }));
}

int BlockLayout::last_position(int course) const {
  int last = 0;
  for (const Block& block : blocks)
    if (block.index.course == course) last = std::max(last, block.index.position);
  return last;
}

BlockLayout lay_blocks(const BridgeDescription& description) {
  if (!description.blocks.empty()) return given_blocks(description);
  BlockLayout layout;
  const std::vector<ArchOpening> openings = add_arches(description, layout.blocks);
  std::vector<WallPart> parts = {WallPart{.courses = description.wall}};
  parts.insert(parts.end(), description.parts.begin(), description.parts.end());
  int courses = 0;
  for (const WallPart& part : parts) {
    const SmallPieces pieces = add_part(part, courses, openings, description.joint_tolerance, layout.blocks);
    layout.small_pieces.joined += pieces.joined;
    layout.small_pieces.left += pieces.left;
    courses += part.courses.courses;
  }
  number_by_courses(layout.blocks);
  if (layout.blocks.empty()) throw InputError("the bridge has no blocks: give it courses or spans");
  if (description.parts.empty()) return layout;
  mark_top(layout.blocks);
  check_parts(description, layout.blocks);
  return layout;
}

}  // namespace voussoir
