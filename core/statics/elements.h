#pragma once
/// @file Going through the triangles and joints that are there: what assemblies share.

#include <array>

#include "core/statics/equilibrium.h"

namespace voussoir {

inline std::array<NodeId, 4> corners(const Joint& joint) {
  return {joint.first_edge.from, joint.first_edge.to, joint.second_edge.from, joint.second_edge.to};
}

/// Displacement components of some nodes: 2 node, 2 node + 1, ...
template <std::size_t N>
std::array<int, 2 * N> components(const std::array<NodeId, N>& nodes) {
  std::array<int, 2 * N> result;
  for (std::size_t i = 0; i < N; ++i) {
    result[2 * i] = 2 * value(nodes[i]);
    result[2 * i + 1] = 2 * value(nodes[i]) + 1;
  }
  return result;
}

template <std::size_t N>
Eigen::Matrix<double, static_cast<int>(2 * N), 1> gathered(const Field& field,
                                                           const std::array<NodeId, N>& nodes) {
  Eigen::Matrix<double, static_cast<int>(2 * N), 1> local;
  for (std::size_t i = 0; i < N; ++i)
    local.template segment<2>(static_cast<int>(2 * i)) = field.col(value(nodes[i]));
  return local;
}

/// Calls `visit(triangle, block)` for every triangle of a block that is there.
template <class Visit>
void for_present_triangles(const StageEquations& equations, const Visit& visit) {
  const Mesh& mesh = equations.system->structure->mesh;
  for (std::size_t block = 0; block < equations.removed.size(); ++block) {
    if (equations.removed[block]) continue;
    const IndexRange& range = mesh.block_triangles[block];
    for (int t = range.begin; t < range.end; ++t) visit(static_cast<std::size_t>(t), block);
  }
}

/// Gives all nodes of removed blocks this value in both directions.
inline void fill_removed(const StageEquations& equations, double with, Field& field) {
  const Mesh& mesh = equations.system->structure->mesh;
  for (std::size_t block = 0; block < equations.removed.size(); ++block)
    if (equations.removed[block])
      field.middleCols(mesh.block_nodes[block].begin, mesh.block_nodes[block].size()).setConstant(with);
}

/// Is it between blocks that are there?
inline bool is_present(const StageEquations& equations, const Joint& joint) {
  return !equations.removed[static_cast<std::size_t>(value(joint.first))] &&
         !equations.removed[static_cast<std::size_t>(value(joint.second))];
}

/// Calls `visit(joint, its number)` for every joint between blocks that are there.
template <class Visit>
void for_present_joints(const StageEquations& equations, const Visit& visit) {
  const std::vector<Joint>& joints = equations.system->structure->joints;
  for (std::size_t j = 0; j < joints.size(); ++j)
    if (is_present(equations, joints[j])) visit(joints[j], j);
}

}  // namespace voussoir
