#pragma once
/// @file A bridge made ready: everything that all scenes share.

#include <optional>
#include <vector>

#include "core/structure/block_layout.h"
#include "core/structure/bridge_description.h"
#include "core/structure/control_point.h"
#include "core/structure/joint.h"
#include "core/structure/mesh.h"
#include "core/structure/mirror_symmetry.h"

namespace voussoir {

struct Bridge {
  BridgeDescription description;
  BlockLayout layout;
  Mesh mesh;
  std::vector<Joint> joints;
  std::vector<ControlPoint> control_points;
  std::optional<MirrorSymmetry> symmetry;

  int block_count() const { return static_cast<int>(layout.size()); }
};

/// bridge description -> blocks -> mesh -> joints, control points, symmetry.
/// Throws InputError if the description gives no bridge (no blocks, no control points, a block without
/// support...).
Bridge make_bridge(const BridgeDescription& description);

}  // namespace voussoir
