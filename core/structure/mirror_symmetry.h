#pragma once
/// @file Mirror symmetry of a bridge, found on its geometry, and mirror images of scenes and fields.

#include <optional>

#include "core/structure/joint.h"
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

/// The image of each joint; the number of joints where there is none.
std::vector<std::size_t> joint_images(const std::vector<Joint>& joints, const MirrorSymmetry& symmetry);

/// Slip at the ends of the joints, 2 x joints: the image joint slips as far the other way. Nothing if it is
/// empty.
Eigen::Matrix2Xd mirrored_slip(const Eigen::Matrix2Xd& slip, const std::vector<Joint>& joints,
                               const MirrorSymmetry& symmetry);

/// u_x changes sign, u_y stays, node by image node.
Field mirrored(const Field& field, const MirrorSymmetry& symmetry);

}  // namespace voussoir
