#include "core/structure/reading_weights.h"

#include <limits>

namespace voussoir {

std::vector<NodeWeight> displacement_weights(const Place& place, const Point& direction, const Mesh& mesh) {
  const IndexRange range = mesh.block_triangles[static_cast<std::size_t>(value(place.block))];
  std::vector<NodeWeight> weights;
  double best =
      -std::numeric_limits<double>::infinity();  // the triangle about the place has no negative share
  for (int t = range.begin; t < range.end; ++t) {
    const Triangle& triangle = mesh.triangles[static_cast<std::size_t>(t)];
    const Eigen::Vector3d shares = barycentric_coordinates(mesh, triangle, place.position);
    if (shares.minCoeff() <= best) continue;
    best = shares.minCoeff();
    weights.clear();
    for (std::size_t corner = 0; corner < 3; ++corner)
      weights.push_back({triangle.nodes[corner], shares[static_cast<int>(corner)] * direction});
  }
  return weights;
}

std::vector<NodeWeight> rotation_weights(BlockId block, const Mesh& mesh) {
  const IndexRange range = mesh.block_nodes[static_cast<std::size_t>(value(block))];
  const auto nodes = mesh.nodes.middleCols(range.begin, range.size());
  const Point centre = nodes.rowwise().mean();
  const double inertia = (nodes.colwise() - centre).squaredNorm();
  std::vector<NodeWeight> weights;
  for (int node = range.begin; node < range.end; ++node) {
    const Point arm = mesh.nodes.col(node) - centre;
    weights.push_back({NodeId{node}, Point(-arm.y(), arm.x()) / inertia});
  }
  return weights;
}

std::vector<NodeWeight> distance_weights(const Place& from, const Place& to, const Mesh& mesh) {
  const Point direction = (to.position - from.position).normalized();
  std::vector<NodeWeight> weights = displacement_weights(to, direction, mesh);
  const std::vector<NodeWeight> start = displacement_weights(from, -direction, mesh);
  weights.insert(weights.end(), start.begin(), start.end());
  return weights;
}

double weighted_sum(const std::vector<NodeWeight>& weights, const Field& field) {
  double sum = 0.0;
  for (const NodeWeight& part : weights) sum += part.weight.dot(field.col(value(part.node)));
  return sum;
}

}  // namespace voussoir
