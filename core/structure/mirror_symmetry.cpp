#include "core/structure/mirror_symmetry.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace voussoir {
namespace {

constexpr double kRelativeTolerance = 1e-9;  ///< of the bridge's length: round-off of the layout is 1e-15

/// Finds, for the points of one cloud, the equal point of another (within a tolerance) by a sorted sweep.
class PointIndex {
 public:
  PointIndex(const Eigen::Matrix2Xd& points, IndexRange range) {
    for (int i = range.begin; i < range.end; ++i) by_x_.emplace(points(0, i), i);
    points_ = &points;
  }
  std::optional<int> find(const Point& p, double tolerance) const {
    for (auto it = by_x_.lower_bound(p.x() - tolerance); it != by_x_.end() && it->first <= p.x() + tolerance;
         ++it)
      if (std::abs((*points_)(1, it->second) - p.y()) <= tolerance) return it->second;
    return std::nullopt;
  }

 private:
  std::multimap<double, int> by_x_;
  const Eigen::Matrix2Xd* points_;
};

Point across(const Point& p, double axis_x) {
  return {2.0 * axis_x - p.x(), p.y()};
}

std::optional<std::vector<BlockId>> block_images(const BlockLayout& layout, double axis_x, double tolerance) {
  std::vector<BlockId> images;
  for (const Block& block : layout.blocks) {
    const Point image_centre = across(centroid(block.polygon), axis_x);
    const double image_area = area(block.polygon);
    const auto image = std::find_if(layout.blocks.begin(), layout.blocks.end(), [&](const Block& other) {
      return other.role == block.role && other.index.course == block.index.course &&
             other.kind == block.kind && other.polygon.size() == block.polygon.size() &&
             (centroid(other.polygon) - image_centre).norm() <= tolerance &&
             std::abs(area(other.polygon) - image_area) <= tolerance * tolerance + 1e-9 * image_area;
    });
    if (image == layout.blocks.end()) return std::nullopt;
    images.push_back(BlockId{static_cast<std::int32_t>(image - layout.blocks.begin())});
  }
  return images;
}

std::optional<std::vector<NodeId>> node_images(const Mesh& mesh, const std::vector<BlockId>& block_image,
                                               double axis_x, double tolerance) {
  std::vector<NodeId> images(static_cast<std::size_t>(mesh.node_count()));
  for (std::size_t block = 0; block < block_image.size(); ++block) {
    const PointIndex index(mesh.nodes, mesh.block_nodes[static_cast<std::size_t>(value(block_image[block]))]);
    const IndexRange own = mesh.block_nodes[block];
    for (int node = own.begin; node < own.end; ++node) {
      const auto image = index.find(across(mesh.nodes.col(node), axis_x), tolerance);
      if (!image) return std::nullopt;
      images[static_cast<std::size_t>(node)] = NodeId{*image};
    }
  }
  return images;
}

/// The triangles as sorted node triples, so that two meshes can be compared whatever the order.
std::set<std::array<NodeId, 3>> triangle_set(const Mesh& mesh, const std::vector<NodeId>& rename) {
  std::set<std::array<NodeId, 3>> triples;
  for (const Triangle& triangle : mesh.triangles) {
    std::array<NodeId, 3> triple = triangle.nodes;
    for (NodeId& node : triple) node = rename[static_cast<std::size_t>(value(node))];
    std::sort(triple.begin(), triple.end());
    triples.insert(triple);
  }
  return triples;
}

using JointNodes = std::array<int, 4>;  // in ascending order

JointNodes nodes_of(const Joint& joint, const std::vector<NodeId>* image) {
  JointNodes nodes = {value(joint.first_edge.from), value(joint.first_edge.to), value(joint.second_edge.from),
                      value(joint.second_edge.to)};
  if (image)
    for (int& node : nodes) node = value((*image)[static_cast<std::size_t>(node)]);
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

}  // namespace

std::optional<MirrorSymmetry> find_mirror_symmetry(const BlockLayout& layout, const Mesh& mesh,
                                                   double axis_x) {
  const double size = (mesh.nodes.rowwise().maxCoeff() - mesh.nodes.rowwise().minCoeff()).norm();
  const double tolerance = kRelativeTolerance * size;
  auto blocks = block_images(layout, axis_x, tolerance);
  if (!blocks) return std::nullopt;
  auto nodes = node_images(mesh, *blocks, axis_x, tolerance);
  if (!nodes) return std::nullopt;

  std::vector<NodeId> same(nodes->size());
  for (std::size_t i = 0; i < same.size(); ++i) same[i] = NodeId{static_cast<std::int32_t>(i)};
  if (triangle_set(mesh, same) != triangle_set(mesh, *nodes)) return std::nullopt;
  return MirrorSymmetry{std::move(*blocks), std::move(*nodes)};
}

std::vector<BlockId> mirrored(const std::vector<BlockId>& blocks, const MirrorSymmetry& symmetry) {
  std::vector<BlockId> images;
  for (const BlockId block : blocks)
    images.push_back(symmetry.block_image[static_cast<std::size_t>(value(block))]);
  std::sort(images.begin(), images.end());
  return images;
}

Scene mirrored(const Scene& scene, const MirrorSymmetry& symmetry) {
  return {mirrored(scene.removed, symmetry)};
}

std::vector<std::size_t> joint_images(const std::vector<Joint>& joints, const MirrorSymmetry& symmetry) {
  std::map<JointNodes, std::size_t> places;
  for (std::size_t i = 0; i < joints.size(); ++i) places[nodes_of(joints[i], nullptr)] = i;
  std::vector<std::size_t> images;
  for (const Joint& joint : joints) {
    const auto image = places.find(nodes_of(joint, &symmetry.node_image));
    images.push_back(image == places.end() ? joints.size() : image->second);
  }
  return images;
}

Eigen::Matrix2Xd mirrored_slip(const Eigen::Matrix2Xd& slip, const std::vector<Joint>& joints,
                               const MirrorSymmetry& symmetry) {
  Eigen::Matrix2Xd image = Eigen::Matrix2Xd::Zero(2, slip.cols());
  if (slip.size() == 0) return image;
  const std::vector<std::size_t> images = joint_images(joints, symmetry);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (images[i] == joints.size()) continue;
    const BlockId first = symmetry.block_image[static_cast<std::size_t>(value(joints[i].first))];
    const bool runs_back = joints[images[i]].first == first;
    const auto from = slip.col(static_cast<Eigen::Index>(i));
    const auto to = static_cast<Eigen::Index>(images[i]);
    image.col(to) << -from[runs_back ? 1 : 0], -from[runs_back ? 0 : 1];
  }
  return image;
}

Field mirrored(const Field& field, const MirrorSymmetry& symmetry) {
  Field image(2, field.cols());
  for (Eigen::Index node = 0; node < field.cols(); ++node) {
    const int target = value(symmetry.node_image[static_cast<std::size_t>(node)]);
    image.col(target) << -field(0, node), field(1, node);
  }
  return image;
}

}  // namespace voussoir
