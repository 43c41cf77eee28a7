#include "core/structure/bridge_description.h"

#include "core/structure/block_boxes.h"

namespace voussoir {

Bounds bounds_of(const BridgeDescription& description) {
  if (description.blocks.empty()) return {Point::Zero(), description.wall.length};
  const Box box = box_of(description.blocks);
  return {box.min(), box.sizes().x()};
}

}  // namespace voussoir
