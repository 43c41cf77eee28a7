#include "core/structure/bridge_description.h"

namespace voussoir {

Bounds bounds_of(const BridgeDescription& description) {
  if (description.blocks.empty()) return {Point::Zero(), description.wall.length};
  Point low = description.blocks.front().polygon.front(), high = low;
  for (const Block& block : description.blocks)
    for (const Point& corner : block.polygon) {
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
  return {low, high.x() - low.x()};
}

}  // namespace voussoir
