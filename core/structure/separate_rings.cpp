#include "core/structure/separate_rings.h"

#include <set>

#include "core/geometry/box.h"
#include "core/geometry/facing_edges.h"

namespace voussoir {
namespace {

bool share_face(const Polygon& first, const Polygon& second, double tolerance) {
  for (std::size_t i = 0; i < first.size(); ++i)
    for (std::size_t j = 0; j < second.size(); ++j)
      if (facing_stretch({first[i], first[(i + 1) % first.size()]},
                         {second[j], second[(j + 1) % second.size()]}, tolerance))
        return true;
  return false;
}

/// The ring blocks that hang together with this one, itself included.
std::vector<std::size_t> group_of(std::size_t first, const std::vector<Block>& blocks,
                                  const std::vector<Box>& boxes, double tolerance) {
  std::vector<std::size_t> group = {first};
  std::vector<bool> found(blocks.size(), false);
  found[first] = true;
  for (std::size_t next = 0; next < group.size(); ++next)
    for (std::size_t other = 0; other < blocks.size(); ++other) {
      const std::size_t one = group[next];
      if (found[other] || blocks[other].ring != blocks[one].ring) continue;
      if (boxes[one].squaredExteriorDistance(boxes[other]) > tolerance * tolerance) continue;
      if (!share_face(blocks[one].polygon, blocks[other].polygon, tolerance)) continue;
      found[other] = true;
      group.push_back(other);
    }
  return group;
}

}  // namespace

void separate_rings(double tolerance, std::vector<Block>& blocks) {
  std::vector<Box> boxes;
  std::set<int> taken;
  for (const Block& block : blocks) {
    boxes.push_back(box_of(block.polygon));
    taken.insert(block.ring);
  }
  std::set<int> kept;
  std::vector<bool> done(blocks.size(), false);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (done[b] || blocks[b].ring == kNoRing) continue;
    const std::vector<std::size_t> group = group_of(b, blocks, boxes, tolerance);
    int number = blocks[b].ring;
    if (!kept.insert(number).second) {
      for (number = 0; taken.contains(number);) ++number;
      taken.insert(number);
      kept.insert(number);
    }
    for (const std::size_t member : group) {
      done[member] = true;
      blocks[member].ring = number;
    }
  }
}

}  // namespace voussoir
