#pragma once
/// @file Mirror symmetry of a bridge, found on its geometry, and mirror images of scenes and fields.

#include <optional>

#include "core/structure/mesh.h"
#include "core/structure/scene.h"

namespace voussoir {

/// The mirror image, across the vertical through the middle of the bridge, of every block and node.
struct MirrorSymmetry {
  std::vector<BlockId> block_image;
  std::vector<NodeId> node_image;
};

/// The symmetry if every block and every node has a mirror image within a nanometre times the bridge's size,
/// and every triangle and boundary edge one between the image nodes; otherwise nothing.
std::optional<MirrorSymmetry> find_mirror_symmetry(const BlockLayout& layout, const Mesh& mesh,
                                                   double axis_x);

/// The image blocks, ascending.
std::vector<BlockId> mirrored(const std::vector<BlockId>& blocks, const MirrorSymmetry& symmetry);

Scene mirrored(const Scene& scene, const MirrorSymmetry& symmetry);

/// u_x changes sign, u_y stays, node by image node.
Field mirrored(const Field& field, const MirrorSymmetry& symmetry);

}  // namespace voussoir
