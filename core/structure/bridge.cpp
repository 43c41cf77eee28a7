#include "core/structure/bridge.h"

#include "core/error.h"

namespace voussoir {

Bridge make_bridge(const BridgeDescription& description) {
  Bridge bridge;
  bridge.description = description;
  bridge.layout = lay_blocks(description);
  const double axis_x = 0.5 * description.wall.length;
  bridge.mesh = make_mesh(bridge.layout, description.mesh, axis_x);
  bridge.joints = find_joints(bridge.mesh, description.joint_tolerance);
  bridge.control_points = find_control_points(bridge.layout, bridge.mesh, description);
  bridge.symmetry = find_mirror_symmetry(bridge.layout, bridge.mesh, axis_x);
  if (bridge.control_points.empty())
    throw InputError("the bridge has no control points: switch on top or arch");
  return bridge;
}

}  // namespace voussoir
