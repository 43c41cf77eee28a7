#include "core/structure/assembly_check.h"
#include "core/units.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <set>

#include "core/error.h"
#include "core/geometry/box.h"
#include "core/geometry/columns.h"
#include "core/geometry/facing_edges.h"
#include "core/geometry/overlap.h"
#include "core/geometry/snapping.h"
#include "core/median.h"
#include "core/structure/block_limits.h"
#include "core/text.h"

namespace voussoir {
namespace {

constexpr double kSmallestArea = 1e-6;       ///< [m2] of a block
constexpr double kLongestAssembly = 1000.0;  ///< [m] no masonry bridge is longer
constexpr double kLongestMedian = 20.0;      ///< [m] half of the blocks are shorter, if they are of stone

std::string at(const Point& place) {
  return fmt::format("at ({:.4g}, {:.4g})", place.x(), place.y());
}

/// What a list of scenes would take for something else (--scenes).
bool means_scenes(const std::string& label) {
  constexpr std::array kWords = {"intact", "all", "singles", "pairs", "triples"};
  return std::ranges::find(kWords, label) != kWords.end() || label.find("..") != std::string::npos;
}

void check_labels(const std::vector<Block>& blocks) {
  std::set<std::string> labels;
  for (const Block& block : blocks) {
    const bool plain = std::ranges::all_of(block.label, [](unsigned char c) {
      return c > 0x20 && c < 0x7F && c != '+' && c != ';' && c != '*';
    });
    if (block.label.empty() || block.label.size() > kLongestLabel || !plain || means_scenes(block.label))
      throw InputError(
          fmt::format("label {}: expected 1 to {} letters, digits or signs without blanks, + ; * .., and "
                      "none of intact, all, singles, pairs, triples",
                      in_quotes(block.label), kLongestLabel));
    if (!labels.insert(block.label).second)
      throw InputError(
          fmt::format("two blocks are called '{}': expected a label of its own for each", block.label));
  }
}

/// Removes repeated corners, turns clockwise outlines. Returns whether it was turned.
bool put_right(Block& block) {
  Polygon& p = block.polygon;
  p.erase(std::unique(p.begin(), p.end()), p.end());
  if (p.size() > 1 && p.front() == p.back()) p.pop_back();
  if (p.size() < 3 || p.size() > kMostCorners)
    throw InputError(
        fmt::format("block '{}' has {} corners: expected 3 to {}", block.label, p.size(), kMostCorners));
  const bool clockwise = area(p) < 0.0;
  if (clockwise) std::reverse(p.begin(), p.end());
  return clockwise;
}

void check_outline(const Block& block, double healed) {
  if (block.polygon.size() < 3 || area(block.polygon) < kSmallestArea)
    throw InputError(fmt::format(
        "block '{}' {} has less than {:g} m2 once corners within {:g} mm (blocks_tolerance_m) are one: "
        "expected "
        "a block of masonry",
        block.label, block.polygon.empty() ? "" : at(block.polygon.front()), kSmallestArea,
        kMillimetres * healed));
  if (const auto place = self_crossing(block.polygon))
    throw InputError(
        fmt::format("block '{}': its outline crosses or touches itself {}", block.label, at(*place)));
}

/// Pairs of blocks whose boxes come nearer than `distance` [m].
std::vector<std::pair<std::size_t, std::size_t>> near_pairs(const std::vector<Block>& blocks,
                                                            double distance) {
  const Point margin = Point::Constant(0.5 * distance);
  std::vector<Box> boxes;
  Box all;
  for (const Block& block : blocks) {
    const Box box = box_of(block.polygon);
    boxes.emplace_back(box.min() - margin, box.max() + margin);
    all.extend(boxes.back());
  }
  Columns columns(all.min().x(), all.max().x(), 1000);
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const double left = boxes[i].min().x(), right = boxes[i].max().x();
    for (const int j : columns.between(left, right))
      if (boxes[i].intersects(boxes[static_cast<std::size_t>(j)]))
        pairs.emplace_back(static_cast<std::size_t>(j), i);
    columns.add(static_cast<int>(i), left, right);
  }
  return pairs;
}

double perimeter(const Polygon& polygon) {
  double sum = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    sum += (polygon[(i + 1) % polygon.size()] - polygon[i]).norm();
  return sum;
}

void check_overlap(const Block& a, const Block& b, double tolerance) {
  const Overlap overlap = overlap_of(a.polygon, b.polygon);
  if (overlap.area > tolerance * std::min(perimeter(a.polygon), perimeter(b.polygon)))
    throw InputError(fmt::format("blocks '{}' and '{}' overlap by {:.3g} m2 {}", a.label, b.label,
                                 overlap.area, at(overlap.place)));
}

/// Which gaps are mistakes.
struct Gaps {
  double joint;       ///< [m] edges closer than this form a joint
  double touches;     ///< [m] the widest gap that needs no correction
  double range;       ///< [m] wider ones are meant
  bool beside_rings;  ///< are they mistakes there, too?
};

/// Is a place between two blocks part of a third, a thin one?
bool is_filled(const Point& place, const Block& a, const Block& b, const std::vector<Block>& blocks) {
  return std::ranges::any_of(blocks, [&](const Block& other) {
    return &other != &a && &other != &b && contains(other.polygon, place);
  });
}

/// Do two of the blocks touch along an edge? Throws if they run beside each other with a gap.
bool touch(const Block& a, const Block& b, const std::vector<Block>& blocks, const Gaps& gaps) {
  const bool meant = !gaps.beside_rings && (a.role == BlockRole::ring || b.role == BlockRole::ring);
  bool joined = false;
  for (std::size_t i = 0; i < a.polygon.size(); ++i)
    for (std::size_t j = 0; j < b.polygon.size(); ++j) {
      const Edge first{a.polygon[i], a.polygon[(i + 1) % a.polygon.size()]};
      const Edge second{b.polygon[j], b.polygon[(j + 1) % b.polygon.size()]};
      if (facing_stretch(first, second, gaps.joint)) {
        joined = true;
        continue;
      }
      const auto stretch = meant ? std::nullopt : facing_stretch(first, second, gaps.range);
      if (!stretch || stretch->length < 2.0 * gaps.range) continue;
      const Point along = first.to - first.from;
      const Point place = first.from + stretch->on_first[0] * along;
      const Point other = second.from + stretch->on_second[0] * (second.to - second.from);
      const double gap = -cross(along, other - first.from) / along.norm();
      const Point outwards = Point(along.y(), -along.x()).normalized();
      const Point middle =
          place + 0.5 * (stretch->on_first[1] - stretch->on_first[0]) * along + 0.5 * gap * outwards;
      if (is_filled(middle, a, b, blocks)) continue;
      throw InputError(
          fmt::format("blocks '{}' and '{}' lie {:.3g} mm apart {} along {:.3g} m: expected blocks that "
                      "touch within {:g} mm or are more than {:g} mm apart",
                      a.label, b.label, kMillimetres * gap, at(place), stretch->length,
                      kMillimetres * gaps.touches, kMillimetres * gaps.range));
    }
  return joined;
}

double ground_below(const std::vector<Block>& blocks) {
  double ground = std::numeric_limits<double>::infinity();
  for (const Block& block : blocks)
    for (const Point& p : block.polygon) ground = std::min(ground, p.y());
  return ground;
}

/// Every block must have a corner that is held, or touch others that do.
void check_carried(const std::vector<Block>& blocks, const BlockPairs& touching,
                   const std::function<bool(const Point&)>& is_held) {
  std::vector<bool> held;
  for (const Block& block : blocks) held.push_back(std::ranges::any_of(block.polygon, is_held));
  if (const auto loose = first_loose(held, touching))
    throw InputError(
        fmt::format("block '{}' {} is loose: expected blocks that touch others, down to the ground at "
                    "y = {:g}",
                    blocks[*loose].label, at(centroid(blocks[*loose].polygon)), ground_below(blocks)));
}

/// Corners that lie this near to the ground or to the left or right end lie there.
void level(std::vector<Polygon>& polygons, double tolerance) {
  const Box box = box_of(polygons);
  for (Polygon& polygon : polygons)
    for (Point& p : polygon) {
      if (p.y() < box.min().y() + tolerance) p.y() = box.min().y();
      if (p.x() < box.min().x() + tolerance) p.x() = box.min().x();
      if (p.x() > box.max().x() - tolerance) p.x() = box.max().x();
    }
}

std::vector<std::string> heal(std::vector<Block>& blocks, double tolerance) {
  std::vector<std::string> notes;
  int turned = 0;
  std::vector<Polygon> polygons;
  for (Block& block : blocks) {
    turned += put_right(block) ? 1 : 0;
    polygons.push_back(block.polygon);
  }
  if (turned > 0) notes.push_back(fmt::format("turned {} clockwise outlines", turned));
  level(polygons, tolerance);
  const Snapping snapping = snap(polygons, tolerance);
  for (std::size_t i = 0; i < blocks.size(); ++i) blocks[i].polygon = polygons[i];
  if (snapping.moved > 0)
    notes.push_back(fmt::format("moved {} corners and edges by up to {:.2g} mm so that blocks meet",
                                snapping.moved, kMillimetres * snapping.farthest));
  return notes;
}

/// No overlaps, no gaps, and everything is held.
void check_meeting(const std::vector<Block>& blocks, const Gaps& gaps,
                   const std::function<bool(const Point&)>& is_held) {
  BlockPairs touching;
  for (const auto& [a, b] : near_pairs(blocks, 2.0 * gaps.range)) {
    check_overlap(blocks[a], blocks[b], gaps.joint);
    if (touch(blocks[a], blocks[b], blocks, gaps)) touching.emplace_back(a, b);
  }
  check_carried(blocks, touching, is_held);
}

}  // namespace

std::optional<std::size_t> first_loose(const std::vector<bool>& held, const BlockPairs& touching) {
  std::vector<std::size_t> group(held.size());  // the first block of each group stands for it
  std::iota(group.begin(), group.end(), std::size_t{0});
  const auto leader = [&](std::size_t i) {
    while (group[i] != i) i = group[i] = group[group[i]];
    return i;
  };
  for (const auto& [a, b] : touching) group[std::max(leader(a), leader(b))] = std::min(leader(a), leader(b));
  std::set<std::size_t> carried;
  for (std::size_t i = 0; i < held.size(); ++i)
    if (held[i]) carried.insert(leader(i));
  for (std::size_t i = 0; i < held.size(); ++i)
    if (!carried.contains(leader(i))) return i;
  return std::nullopt;
}

void check_laid(const std::vector<Block>& blocks, const LaidTolerance& tolerance,
                const std::function<bool(const Point&)>& is_held) {
  const Gaps gaps{tolerance.joint, tolerance.joint, tolerance.gap, false};
  check_meeting(blocks, gaps, is_held);
}

void expect_metres(const std::vector<Block>& blocks) {
  std::vector<double> lengths;
  Box all;
  for (const Block& block : blocks) {
    if (block.polygon.empty()) continue;
    const Box box = box_of(block.polygon);
    lengths.push_back(box.sizes().maxCoeff());
    all.extend(box);
  }
  if (lengths.empty()) return;
  const double middle = median(lengths);
  const double length = all.sizes().maxCoeff();
  if (length > kLongestAssembly || middle > kLongestMedian)
    throw InputError(
        fmt::format("the bridge is {:.6g} m long and its middling block {:.4g} m: are these millimetres? "
                    "expected metres, at most {:g} and {:g}",
                    length, middle, kLongestAssembly, kLongestMedian));
}

std::vector<std::string> heal_and_check(std::vector<Block>& blocks, const AssemblyTolerance& tolerance) {
  if (blocks.empty()) throw InputError("there are no blocks");
  check_labels(blocks);
  expect_metres(blocks);
  std::vector<std::string> notes = heal(blocks, tolerance.heal);
  for (const Block& block : blocks) check_outline(block, tolerance.heal);
  const double ground = ground_below(blocks);
  check_meeting(blocks, {tolerance.joint, tolerance.heal, kGapRange * tolerance.heal, true},
                [&](const Point& p) { return p.y() <= ground + tolerance.heal; });
  return notes;
}

}  // namespace voussoir
