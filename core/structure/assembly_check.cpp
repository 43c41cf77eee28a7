#include "core/structure/assembly_check.h"

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
#include "core/structure/block_limits.h"
#include "core/text.h"

namespace voussoir {
namespace {

constexpr std::size_t kLongestLabel = 31;  ///< bytes that a database keeps
constexpr double kSmallestArea = 1e-6;     ///< [m2] of a block

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

void check_outline(const Block& block) {
  if (block.polygon.size() < 3 || area(block.polygon) < kSmallestArea)
    throw InputError(fmt::format("block '{}' {} has less than {:g} m2: expected a block of masonry",
                                 block.label, block.polygon.empty() ? "" : at(block.polygon.front()),
                                 kSmallestArea));
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

/// Do two blocks touch along an edge? Throws if they run beside each other with a gap.
bool touch(const Block& a, const Block& b, const AssemblyTolerance& tolerance) {
  bool joined = false;
  for (std::size_t i = 0; i < a.polygon.size(); ++i)
    for (std::size_t j = 0; j < b.polygon.size(); ++j) {
      const Edge first{a.polygon[i], a.polygon[(i + 1) % a.polygon.size()]};
      const Edge second{b.polygon[j], b.polygon[(j + 1) % b.polygon.size()]};
      const double range = kGapRange * tolerance.heal;
      if (facing_stretch(first, second, tolerance.joint)) {
        joined = true;
        continue;
      }
      const auto stretch = facing_stretch(first, second, range);
      if (!stretch || stretch->length < 2.0 * range) continue;
      const Point along = first.to - first.from;
      const Point place = first.from + stretch->on_first[0] * along;
      const Point other = second.from + stretch->on_second[0] * (second.to - second.from);
      const double gap = -cross(along, other - first.from) / along.norm();
      throw InputError(fmt::format(
          "blocks '{}' and '{}' lie {:.3g} mm apart {} along {:.3g} m: expected blocks that "
          "touch within {:g} mm or are more than {:g} mm apart",
          a.label, b.label, 1e3 * gap, at(place), stretch->length, 1e3 * tolerance.heal, 1e3 * range));
    }
  return joined;
}

/// Every block must stand on the ground or on others that do.
void check_carried(const std::vector<Block>& blocks,
                   const std::vector<std::pair<std::size_t, std::size_t>>& touching, double tolerance) {
  double ground = std::numeric_limits<double>::infinity();
  for (const Block& block : blocks)
    for (const Point& p : block.polygon) ground = std::min(ground, p.y());
  std::vector<std::size_t> group(blocks.size());  // the first block of each group stands for it
  std::iota(group.begin(), group.end(), std::size_t{0});
  const auto leader = [&](std::size_t i) {
    while (group[i] != i) i = group[i] = group[group[i]];
    return i;
  };
  for (const auto& [a, b] : touching) group[std::max(leader(a), leader(b))] = std::min(leader(a), leader(b));
  std::set<std::size_t> carried;
  for (std::size_t i = 0; i < blocks.size(); ++i)
    for (const Point& p : blocks[i].polygon)
      if (p.y() <= ground + tolerance) carried.insert(leader(i));
  for (std::size_t i = 0; i < blocks.size(); ++i)
    if (!carried.contains(leader(i)))
      throw InputError(
          fmt::format("block '{}' {} is loose: expected blocks that touch others, down to the ground at "
                      "y = {:g}",
                      blocks[i].label, at(centroid(blocks[i].polygon)), ground));
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
                                snapping.moved, 1e3 * snapping.farthest));
  return notes;
}

}  // namespace

void check_overlaps(const std::vector<Block>& blocks, double tolerance) {
  for (const auto& [a, b] : near_pairs(blocks, 0.0)) check_overlap(blocks[a], blocks[b], tolerance);
}

std::vector<std::string> heal_and_check(std::vector<Block>& blocks, const AssemblyTolerance& tolerance) {
  if (blocks.empty()) throw InputError("there are no blocks");
  check_labels(blocks);
  std::vector<std::string> notes = heal(blocks, tolerance.heal);
  for (const Block& block : blocks) check_outline(block);
  std::vector<std::pair<std::size_t, std::size_t>> touching;
  for (const auto& [a, b] : near_pairs(blocks, 2.0 * kGapRange * tolerance.heal)) {
    check_overlap(blocks[a], blocks[b], tolerance.joint);
    if (touch(blocks[a], blocks[b], tolerance)) touching.emplace_back(a, b);
  }
  check_carried(blocks, touching, tolerance.heal);
  return notes;
}

}  // namespace voussoir
