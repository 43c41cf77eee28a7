#include "core/structure/block_boxes.h"

namespace voussoir {

Box box_of(const std::vector<Block>& blocks) {
  Box box;
  for (const Block& block : blocks) box.extend(box_of(block.polygon));
  return box;
}

std::map<int, Box> boxes_of_rings(const std::vector<Block>& blocks) {
  std::map<int, Box> boxes;
  for (const Block& block : blocks) boxes[block.ring].extend(box_of(block.polygon));
  return boxes;
}

}  // namespace voussoir
