#include "core/statics/equilibrium.h"

#include <algorithm>
#include <array>

namespace voussoir {
namespace {

std::array<NodeId, 4> corners(const Joint& joint) {
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

template <std::size_t N, typename Vector>
void subtract_at(Field& field, const std::array<NodeId, N>& nodes, const Vector& local) {
  for (std::size_t i = 0; i < N; ++i)
    field.col(value(nodes[i])) -= local.template segment<2>(static_cast<int>(2 * i));
}

/// Numbers the displacement components that the supports leave free.
void number_unknowns(const Bridge& bridge, EquilibriumSystem& system) {
  const SupportDescription& supports = bridge.description.supports;
  const double tolerance = 1e-9 * bridge.description.wall.length;
  system.unknown.assign(static_cast<std::size_t>(2 * bridge.mesh.node_count()), -1);
  const auto holds = [](Support support, bool along_normal) {
    return support == Support::clamped || (support == Support::roller && along_normal);
  };
  for (int node = 0; node < bridge.mesh.node_count(); ++node) {
    const Point x = bridge.mesh.nodes.col(node);
    const bool base = std::abs(x.y()) <= tolerance;
    const bool side =
        std::abs(x.x()) <= tolerance || std::abs(x.x() - bridge.description.wall.length) <= tolerance;
    for (int axis = 0; axis < 2; ++axis) {
      const bool held =
          (base && holds(supports.base, axis == 1)) || (side && holds(supports.sides, axis == 0));
      if (held) continue;
      system.unknown[static_cast<std::size_t>(2 * node + axis)] = system.unknown_count();
      system.component.push_back(2 * node + axis);
    }
  }
}

template <std::size_t N>
void add_entries(const EquilibriumSystem& system, const std::array<int, N>& local,
                 std::vector<Eigen::Triplet<double>>& entries) {
  for (const int row : local)
    for (const int column : local) {
      const int i = system.unknown[static_cast<std::size_t>(row)];
      const int j = system.unknown[static_cast<std::size_t>(column)];
      if (i >= 0 && j >= 0) entries.emplace_back(i, j, 0.0);
    }
}

/// Position of entry (row, column) in the compressed value array.
int slot(const Eigen::SparseMatrix<double>& pattern, int row, int column) {
  const int* begin = pattern.innerIndexPtr() + pattern.outerIndexPtr()[column];
  const int* end = pattern.innerIndexPtr() + pattern.outerIndexPtr()[column + 1];
  return static_cast<int>(std::lower_bound(begin, end, row) - pattern.innerIndexPtr());
}

/// Slots of a local matrix stored column by column.
template <std::size_t N>
std::array<int, N * N> local_slots(const EquilibriumSystem& system, const std::array<int, N>& local) {
  std::array<int, N * N> slots;
  for (std::size_t c = 0; c < N; ++c)
    for (std::size_t r = 0; r < N; ++r) {
      const int i = system.unknown[static_cast<std::size_t>(local[r])];
      const int j = system.unknown[static_cast<std::size_t>(local[c])];
      slots[c * N + r] = i >= 0 && j >= 0 ? slot(system.pattern, i, j) : -1;
    }
  return slots;
}

void build_pattern(const Bridge& bridge, EquilibriumSystem& system) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const Triangle& triangle : bridge.mesh.triangles)
    add_entries(system, components(triangle.nodes), entries);
  for (const Joint& joint : bridge.joints) add_entries(system, components(corners(joint)), entries);
  const int n = system.unknown_count();
  for (int i = 0; i < n; ++i) entries.emplace_back(i, i, 0.0);
  system.pattern.resize(n, n);
  system.pattern.setFromTriplets(entries.begin(), entries.end());
  system.pattern.makeCompressed();

  for (const Triangle& triangle : bridge.mesh.triangles)
    system.triangle_slots.push_back(local_slots(system, components(triangle.nodes)));
  for (const Joint& joint : bridge.joints)
    system.joint_slots.push_back(local_slots(system, components(corners(joint))));
  for (int i = 0; i < n; ++i) system.diagonal_slots.push_back(slot(system.pattern, i, i));
}

template <std::size_t N, typename Matrix>
void add_local(const std::array<int, N>& slots, const Matrix& local, TangentTarget tangent) {
  for (std::size_t k = 0; k < N; ++k)
    if (slots[k] >= 0) tangent.first[static_cast<std::size_t>(slots[k]) * tangent.stride] += local.data()[k];
}

Field loads_of_present_blocks(const EquilibriumSystem& system, const std::vector<bool>& removed) {
  const Mesh& mesh = system.bridge->mesh;
  Field forces = system.load;
  for (std::size_t block = 0; block < removed.size(); ++block)
    if (removed[block])
      forces.middleCols(mesh.block_nodes[block].begin, mesh.block_nodes[block].size()).setZero();
  return forces;
}

bool present(const std::vector<bool>& removed, BlockId block) {
  return !removed[static_cast<std::size_t>(value(block))];
}

/// Gives the unknowns of removed blocks an equation of their own: 1 * change = 0.
void pin_removed(const EquilibriumSystem& system, const std::vector<bool>& removed, TangentTarget tangent) {
  const Mesh& mesh = system.bridge->mesh;
  for (std::size_t block = 0; block < removed.size(); ++block) {
    if (!removed[block]) continue;
    for (int c = 2 * mesh.block_nodes[block].begin; c < 2 * mesh.block_nodes[block].end; ++c) {
      const int i = system.unknown[static_cast<std::size_t>(c)];
      if (i >= 0)
        tangent.first[static_cast<std::size_t>(system.diagonal_slots[static_cast<std::size_t>(i)]) *
                      tangent.stride] = 1.0;
    }
  }
}

void clear_held(const EquilibriumSystem& system, Field& forces) {
  for (std::size_t c = 0; c < system.unknown.size(); ++c)
    if (system.unknown[c] < 0) forces.data()[c] = 0.0;
}

}  // namespace

EquilibriumSystem::EquilibriumSystem(const Bridge& bridge_, const Field& dead_load, JointRule rule)
    : bridge(&bridge_), joint_rule(rule), moduli(plane_moduli(bridge_.description.material)) {
  const Mesh& mesh = bridge->mesh;
  weight.setZero(mesh.node_count());
  const double specific = bridge->description.material.density * bridge->description.gravity *
                          bridge->description.material.thickness;
  for (std::size_t block = 0; block < bridge->layout.size(); ++block)
    for (int t = mesh.block_triangles[block].begin; t < mesh.block_triangles[block].end; ++t) {
      const auto& nodes = mesh.triangles[static_cast<std::size_t>(t)].nodes;
      triangles.push_back(
          triangle_shape(mesh.position(nodes[0]), mesh.position(nodes[1]), mesh.position(nodes[2])));
      triangle_block.push_back(BlockId{static_cast<std::int32_t>(block)});
      for (const NodeId node : nodes) weight[value(node)] += specific * triangles.back().area / 3.0;
    }
  load = dead_load.size() > 0 ? dead_load : Field::Zero(2, mesh.node_count());
  load.row(1) -= weight.transpose();
  largest_load = load.cwiseAbs().maxCoeff();
  if (largest_load == 0.0) largest_load = 1.0;
  for (const Joint& joint : bridge->joints) joints.push_back(make_joint_frame(joint, mesh));
  number_unknowns(*bridge, *this);
  build_pattern(*bridge, *this);
}

Field unbalanced_forces(const EquilibriumSystem& system, const std::vector<bool>& removed,
                        const Field& displacement) {
  const Bridge& bridge = *system.bridge;
  const double thickness = bridge.description.material.thickness;
  Field forces = loads_of_present_blocks(system, removed);
  for (std::size_t t = 0; t < system.triangles.size(); ++t) {
    if (!present(removed, system.triangle_block[t])) continue;
    const auto& nodes = bridge.mesh.triangles[t].nodes;
    subtract_at(forces, nodes,
                triangle_force(system.triangles[t], system.moduli, thickness, gathered(displacement, nodes)));
  }
  for (std::size_t j = 0; j < system.joints.size(); ++j) {
    const Joint& joint = bridge.joints[j];
    if (!present(removed, joint.first) || !present(removed, joint.second)) continue;
    const JointKinematics kinematics =
        joint_kinematics(system.joints[j], gathered(displacement, corners(joint)));
    const JointResponse response = integrate_joint(bridge.description.joints, joint.length * thickness,
                                                   kinematics.state, system.joint_rule);
    subtract_at(forces, corners(joint), kinematics.gradient.transpose().lazyProduct(response.force).eval());
  }
  clear_held(system, forces);
  return forces;
}

Field assemble(const EquilibriumSystem& system, const std::vector<bool>& removed, const Field& displacement,
               double bonding, TangentTarget tangent) {
  const Bridge& bridge = *system.bridge;
  const double thickness = bridge.description.material.thickness;
  Field forces = loads_of_present_blocks(system, removed);
  for (std::size_t i = 0; i < static_cast<std::size_t>(system.pattern.nonZeros()); ++i)
    tangent.first[i * tangent.stride] = 0.0;
  for (std::size_t t = 0; t < system.triangles.size(); ++t) {
    if (!present(removed, system.triangle_block[t])) continue;
    const auto& nodes = bridge.mesh.triangles[t].nodes;
    const TriangleResponse response =
        triangle_response(system.triangles[t], system.moduli, thickness, gathered(displacement, nodes));
    subtract_at(forces, nodes, response.force);
    add_local(system.triangle_slots[t], response.tangent, tangent);
  }
  for (std::size_t j = 0; j < system.joints.size(); ++j) {
    const Joint& joint = bridge.joints[j];
    if (!present(removed, joint.first) || !present(removed, joint.second)) continue;
    const Vector8d q = gathered(displacement, corners(joint));
    const JointKinematics kinematics = joint_kinematics(system.joints[j], q);
    JointResponse response = integrate_joint(bridge.description.joints, joint.length * thickness,
                                             kinematics.state, system.joint_rule);
    subtract_at(forces, corners(joint), kinematics.gradient.transpose().lazyProduct(response.force).eval());
    if (bonding > 0.0)
      response.tangent = (1.0 - bonding) * response.tangent +
                         bonding * bonded_joint_tangent(bridge.description.joints, joint.length * thickness);
    Matrix8d stiffness = joint_geometric_stiffness(system.joints[j], q, kinematics, response.force);
    const Eigen::Matrix<double, 4, 8> turned = response.tangent.lazyProduct(kinematics.gradient);
    stiffness += kinematics.gradient.transpose().lazyProduct(turned);
    add_local(system.joint_slots[j], stiffness, tangent);
  }
  pin_removed(system, removed, tangent);
  clear_held(system, forces);
  return forces;
}

std::vector<bool> removal_mask(const Scene& scene, std::size_t block_count) {
  std::vector<bool> removed(block_count, false);
  for (const BlockId block : scene.removed) removed[static_cast<std::size_t>(value(block))] = true;
  return removed;
}

double unbalanced_force(const Bridge& bridge, const Scene& scene, const Field& displacement) {
  const EquilibriumSystem system(bridge);
  const Field clean = displacement.array().isNaN().select(0.0, displacement);
  return unbalanced_forces(system, removal_mask(scene, bridge.layout.size()), clean).cwiseAbs().maxCoeff() /
         system.largest_load;
}

}  // namespace voussoir
