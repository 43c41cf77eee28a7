#include "core/structure/small_pieces.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <tuple>

#include "core/geometry/facing_edges.h"

namespace voussoir {
namespace {

constexpr double kAlike = 1e-9;  // of an area: mirror images of a piece at the limit are treated alike

double shared_length(const Polygon& first, const Polygon& second, double tolerance) {
  double length = 0.0;
  for (std::size_t i = 0; i < first.size(); ++i)
    for (std::size_t j = 0; j < second.size(); ++j)
      if (const auto stretch = facing_stretch({first[i], first[(i + 1) % first.size()]},
                                              {second[j], second[(j + 1) % second.size()]}, tolerance))
        length += stretch->length;
  return length;
}

/// The smallest block laid in courses that is too small, those aside that have been found to have no
/// neighbour.
std::optional<std::size_t> smallest_piece(const std::vector<Block>& blocks, double smallest_area,
                                          const std::set<BlockIndex>& without_neighbour) {
  std::optional<std::size_t> smallest;
  double least = smallest_area * (1.0 - kAlike);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (blocks[i].role == BlockRole::ring || without_neighbour.contains(blocks[i].index)) continue;
    const double size = area(blocks[i].polygon);
    if (size < least) {
      least = size;
      smallest = i;
    }
  }
  return smallest;
}

struct Neighbour {
  std::size_t block;
  double length;  ///< of the shared edges [m]
};

/// The blocks of the same part that share edges with a piece, the longest first; of equal ones those in the
/// same course, then the lower ones.
std::vector<Neighbour> neighbours_of(const std::vector<Block>& blocks, const Block& piece, double tolerance) {
  std::vector<Neighbour> result;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (&blocks[i] == &piece || blocks[i].role != piece.role) continue;
    const double length = shared_length(piece.polygon, blocks[i].polygon, tolerance);
    if (length > tolerance) result.push_back({i, length});
  }
  const auto rank = [&](const Neighbour& neighbour) {
    const int course = blocks[neighbour.block].index.course;
    return std::tuple(std::round(-neighbour.length / tolerance), course != piece.index.course, course);
  };
  std::stable_sort(result.begin(), result.end(),
                   [&](const Neighbour& a, const Neighbour& b) { return rank(a) < rank(b); });
  return result;
}

bool add_to(Block& block, const Polygon& polygon, bool top_course) {
  auto both = joined(block.polygon, polygon);
  if (!both) return false;
  block.polygon = std::move(*both);
  block.kind = BlockKind::cut;
  block.top_course |= top_course;
  return true;
}

/// The parts of a polygon to the left and to the right of a vertical line.
std::vector<Polygon> halves(const Polygon& polygon, double x) {
  constexpr double kFar = 1e6;  // [m]
  const Polygon right = {{x, -kFar}, {kFar, -kFar}, {kFar, kFar}, {x, kFar}};
  std::vector<Polygon> parts = subtract(polygon, right, 0.0);
  for (Polygon& part : subtract(polygon, mirrored(right, x), 0.0)) parts.push_back(std::move(part));
  return parts;
}

/// A piece in the middle between two equal neighbours of one course is cut in two, a half for each: a bridge
/// that is its own mirror image stays so.
bool share_out(std::vector<Block>& blocks, const Block& piece, const Neighbour& first,
               const Neighbour& second, double tolerance) {
  Block left = blocks[first.block], right = blocks[second.block];
  if (left.index.course != right.index.course || std::abs(first.length - second.length) > tolerance)
    return false;
  const std::vector<Polygon> parts = halves(piece.polygon, centroid(piece.polygon).x());
  if (parts.size() != 2 || !add_to(left, parts[0], piece.top_course) ||
      !add_to(right, parts[1], piece.top_course))
    return false;
  blocks[first.block] = std::move(left);
  blocks[second.block] = std::move(right);
  return true;
}

bool join_to_neighbour(std::vector<Block>& blocks, const Block& piece, double tolerance) {
  const std::vector<Neighbour> neighbours = neighbours_of(blocks, piece, tolerance);
  if (neighbours.size() > 1 && share_out(blocks, piece, neighbours[0], neighbours[1], tolerance)) return true;
  return std::any_of(neighbours.begin(), neighbours.end(), [&](const Neighbour& neighbour) {
    return add_to(blocks[neighbour.block], piece.polygon, piece.top_course);
  });
}

}  // namespace

SmallPieces join_small_pieces(std::vector<Block>& blocks, double smallest_area, double tolerance) {
  SmallPieces result;
  std::set<BlockIndex> without_neighbour;
  while (const auto place = smallest_piece(blocks, smallest_area, without_neighbour)) {
    const Block& piece = blocks[*place];
    if (join_to_neighbour(blocks, piece, tolerance)) {
      blocks.erase(blocks.begin() + static_cast<std::ptrdiff_t>(*place));
      ++result.joined;
    } else {
      without_neighbour.insert(piece.index);
      ++result.left;
    }
  }
  return result;
}

}  // namespace voussoir
