#include "core/structure/rigid_movement.h"

#include "core/geometry/box.h"

namespace voussoir {
namespace {

Point middle(const Support& support, const Mesh& mesh) {
  Box box;
  for (const NodeId node : support.nodes) box.extend(mesh.position(node));
  return box.center();
}

}  // namespace

Field rigid_movement(const Structure& structure, std::size_t support, const Point& movement,
                     double rotation) {
  const Support& moving = structure.supports[support];
  const Point centre = middle(moving, structure.mesh);
  Field field = Field::Zero(2, structure.mesh.node_count());
  for (const NodeId node : moving.nodes) {
    const Point arm = structure.mesh.position(node) - centre;
    if (goes_with(structure.supports, support, node, 0))
      field(0, value(node)) = movement.x() - rotation * arm.y();
    if (goes_with(structure.supports, support, node, 1))
      field(1, value(node)) = movement.y() + rotation * arm.x();
  }
  return field;
}

}  // namespace voussoir
