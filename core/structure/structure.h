#pragma once
/// @file What is where: everything that all variants and scenes of a bridge share.

#include <optional>
#include <vector>

#include "core/structure/block_layout.h"
#include "core/structure/bridge_description.h"
#include "core/structure/control_point.h"
#include "core/structure/joint.h"
#include "core/structure/mesh.h"
#include "core/structure/mirror_symmetry.h"
#include "core/structure/supports.h"

namespace voussoir {

struct Structure {
  BlockLayout layout;
  Mesh mesh;
  std::vector<Joint> joints;
  std::vector<Support> supports;
  std::vector<ControlPoint> control_points;
  std::optional<MirrorSymmetry> symmetry;

  int block_count() const { return static_cast<int>(layout.size()); }
};

/// bridge description -> blocks -> mesh -> joints, supports, control points, symmetry.
/// Throws InputError if the description gives no bridge (no blocks, no control points, a block without
/// support...).
Structure make_structure(const BridgeDescription& description);

/// Mean of the square roots of the blocks' areas [m].
double mean_block_size(const Structure& structure);

/// How blocks that are given as polygons become a structure.
struct AssemblyRules {
  MeshDescription mesh;
  double joint_tolerance = 1e-6;  ///< [m] edges closer than this form a joint
  double mirror_axis = 0.0;       ///< [m] x of the vertical across which mirror images are looked for
};

/// Mesh, joints and symmetry of blocks of any shape. Supports and control points are the caller's to add.
/// Throws InputError if two blocks have the same label or a polygon is not counter-clockwise.
Structure assemble(std::vector<Block> blocks, const AssemblyRules& rules);

}  // namespace voussoir
