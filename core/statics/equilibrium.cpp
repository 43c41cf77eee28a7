#include "core/statics/equilibrium.h"

#include <algorithm>
#include <array>

#include "core/statics/elements.h"

namespace voussoir {
namespace {

template <std::size_t N, typename Vector>
void subtract_at(Field& field, const std::array<NodeId, N>& nodes, const Vector& local) {
  for (std::size_t i = 0; i < N; ++i)
    field.col(value(nodes[i])) -= local.template segment<2>(static_cast<int>(2 * i));
}

/// Numbers the displacement components that the supports leave free.
void number_unknowns(EquilibriumSystem& system) {
  const std::vector<bool> held = held_components(system.structure->supports, system.structure->mesh);
  system.unknown.assign(held.size(), -1);
  for (std::size_t c = 0; c < held.size(); ++c) {
    if (held[c]) continue;
    system.unknown[c] = system.unknown_count();
    system.component.push_back(static_cast<int>(c));
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

void build_pattern(EquilibriumSystem& system) {
  const Structure& structure = *system.structure;
  std::vector<Eigen::Triplet<double>> entries;
  for (const Triangle& triangle : structure.mesh.triangles)
    add_entries(system, components(triangle.nodes), entries);
  for (const Joint& joint : structure.joints) add_entries(system, components(corners(joint)), entries);
  const int n = system.unknown_count();
  for (int i = 0; i < n; ++i) entries.emplace_back(i, i, 0.0);
  system.pattern.resize(n, n);
  system.pattern.setFromTriplets(entries.begin(), entries.end());
  system.pattern.makeCompressed();

  for (const Triangle& triangle : structure.mesh.triangles)
    system.triangle_slots.push_back(local_slots(system, components(triangle.nodes)));
  for (const Joint& joint : structure.joints)
    system.joint_slots.push_back(local_slots(system, components(corners(joint))));
  for (int i = 0; i < n; ++i) system.diagonal_slots.push_back(slot(system.pattern, i, i));
}

template <std::size_t N, typename Matrix>
void add_local(const std::array<int, N>& slots, const Matrix& local, TangentTarget tangent) {
  for (std::size_t k = 0; k < N; ++k)
    if (slots[k] >= 0) tangent.first[static_cast<std::size_t>(slots[k]) * tangent.stride] += local.data()[k];
}

/// Gives the unknowns of removed blocks an equation of their own: 1 * change = 0. Nothing else than a block's
/// own triangles may have been added to their columns.
void pin_removed(const StageEquations& equations, TangentTarget tangent) {
  const EquilibriumSystem& system = *equations.system;
  const Mesh& mesh = system.structure->mesh;
  for (std::size_t block = 0; block < equations.removed.size(); ++block) {
    if (!equations.removed[block]) continue;
    for (int c = 2 * mesh.block_nodes[block].begin; c < 2 * mesh.block_nodes[block].end; ++c) {
      const int i = system.unknown[static_cast<std::size_t>(c)];
      if (i < 0) continue;
      const int* const column = system.pattern.outerIndexPtr() + i;
      for (int at = column[0]; at < column[1]; ++at)
        tangent.first[static_cast<std::size_t>(at) * tangent.stride] = 0.0;
      tangent.first[static_cast<std::size_t>(system.diagonal_slots[static_cast<std::size_t>(i)]) *
                    tangent.stride] = 1.0;
    }
  }
}

void clear_held(const EquilibriumSystem& system, Field& forces) {
  for (std::size_t c = 0; c < system.unknown.size(); ++c)
    if (system.unknown[c] < 0) forces.data()[c] = 0.0;
}

void subtract_triangle_forces(const StageEquations& equations, const Field& displacement, Field& forces) {
  const EquilibriumSystem& system = *equations.system;
  const Coefficients& with = *equations.coefficients;
  for_present_triangles(equations, [&](std::size_t t, std::size_t block) {
    const auto& nodes = system.structure->mesh.triangles[t].nodes;
    subtract_at(forces, nodes,
                triangle_force(system.triangles[t], with.moduli[block], with.thickness[block],
                               gathered(displacement, nodes), equations.heat[block]));
  });
}

void subtract_drag(const StageEquations& equations, const Field& displacement, Field& forces) {
  if (!equations.drag) return;
  const Eigen::RowVectorXd stiffness = equations.coefficients->weight.transpose() / equations.drag->reach;
  forces -= (displacement - equations.drag->place) * stiffness.asDiagonal();
}

void add_stiffness_of_drag(const StageEquations& equations, TangentTarget tangent) {
  if (!equations.drag) return;
  const EquilibriumSystem& system = *equations.system;
  for (std::size_t i = 0; i < system.component.size(); ++i)
    tangent.first[static_cast<std::size_t>(system.diagonal_slots[i]) * tangent.stride] +=
        equations.coefficients->weight[system.component[i] / 2] / equations.drag->reach;
}

/// The force of joint_response alone.
Eigen::Vector4d force_in(const StageEquations& equations, std::size_t joint, const JointState& state) {
  const Coefficients& with = *equations.coefficients;
  if (with.mortar_of(joint) != nullptr || equations.system->joint_rule != JointRule::exact)
    return joint_response(equations, joint, state).force;
  return joint_force(with.joints[joint], equations.memory[joint], state);
}

/// Unbalanced forces, at held components, too.
Field all_forces(const StageEquations& equations, const Field& displacement) {
  const EquilibriumSystem& system = *equations.system;
  Field forces = equations.load;
  subtract_drag(equations, displacement, forces);
  subtract_triangle_forces(equations, displacement, forces);
  for_present_joints(equations, [&](const Joint& joint, std::size_t j) {
    const JointPose pose = joint_pose(system.joints[j], gathered(displacement, corners(joint)));
    subtract_at(forces, corners(joint),
                corner_forces(system.joints[j], pose, force_in(equations, j, pose.state)));
  });
  return forces;
}

}  // namespace

EquilibriumSystem::EquilibriumSystem(const Structure& structure_, JointRule rule)
    : structure(&structure_), joint_rule(rule) {
  const Mesh& mesh = structure->mesh;
  for (const Triangle& triangle : mesh.triangles)
    triangles.push_back(triangle_shape(mesh.position(triangle.nodes[0]), mesh.position(triangle.nodes[1]),
                                       mesh.position(triangle.nodes[2])));
  for (const Joint& joint : structure->joints) joints.push_back(make_joint_frame(joint, mesh));
  number_unknowns(*this);
  build_pattern(*this);
}

Coefficients::Coefficients(const EquilibriumSystem& system, const Parameters& parameters) {
  const Structure& structure = *system.structure;
  weight.setZero(structure.mesh.node_count());
  elastic.assign(static_cast<std::size_t>(system.pattern.nonZeros()), 0.0);
  for (std::size_t block = 0; block < structure.layout.size(); ++block) {
    const Material& material = parameters.blocks[block];
    moduli.push_back(plane_moduli(material));
    thickness.push_back(material.thickness);
    thermal.push_back(thermal_pressure(material));
    const double specific = material.density * parameters.gravity * material.thickness;
    const IndexRange& range = structure.mesh.block_triangles[block];
    for (auto t = static_cast<std::size_t>(range.begin); t < static_cast<std::size_t>(range.end); ++t) {
      for (const NodeId node : structure.mesh.triangles[t].nodes)
        weight[value(node)] += specific * system.triangles[t].area / 3.0;
      const TriangleResponse at_rest =
          triangle_response(system.triangles[t], moduli.back(), thickness.back(), Vector6d::Zero(), 0.0);
      add_local(system.triangle_slots[t], at_rest.tangent, {elastic.data()});
    }
  }
  if (parameters.laid_mass.size() > 0) weight += parameters.gravity * parameters.laid_mass;
  for (std::size_t j = 0; j < structure.joints.size(); ++j) {
    const Joint& joint = structure.joints[j];
    const double area = joint.length * joint_thickness(joint, parameters);
    joints.push_back(joint_stiffness(parameters.joints[j], area));
    if (!parameters.joints[j].mortar.is_there()) continue;
    mortar.resize(structure.joints.size());
    mortar[j] = cohesive_stiffness(parameters.joints[j], area);
  }
}

Coefficients with_joint_stiffness(Coefficients coefficients, const Eigen::ArrayXd& shares) {
  for (std::size_t j = 0; j < coefficients.joints.size(); ++j) {
    JointStiffness& joint = coefficients.joints[j];
    const double share = shares[static_cast<Eigen::Index>(j)];
    joint = {share * joint.normal, share * joint.tangential, share * joint.cap};
  }
  return coefficients;
}

StageEquations::StageEquations(const EquilibriumSystem& system_, const Coefficients& coefficients_,
                               const Stage& stage, std::vector<JointMemory> memory_)
    : system(&system_),
      coefficients(&coefficients_),
      removed(removal_mask(stage.scene, system_.structure->layout.size())),
      memory(std::move(memory_)),
      gravity_share(stage.gravity_share),
      heat(coefficients_.thermal),
      support_movement(stage.support_movement) {
  const Mesh& mesh = system->structure->mesh;
  for (std::size_t b = 0; b < heat.size(); ++b) heat[b] *= temperature_of(stage, b);
  memory.resize(system->joints.size());
  load = stage.load.size() > 0 ? stage.load : Field::Zero(2, mesh.node_count());
  load.row(1) -= gravity_share * coefficients->weight.transpose();
  largest_load = load.cwiseAbs().maxCoeff();
  if (largest_load == 0.0) largest_load = 1.0;
  fill_removed(*this, 0.0, load);
}

Field unbalanced_forces(const StageEquations& equations, const Field& displacement) {
  Field forces = all_forces(equations, displacement);
  clear_held(*equations.system, forces);
  return forces;
}

Field support_forces(const StageEquations& equations, const Field& displacement) {
  Field forces = -all_forces(equations, displacement);
  for (const int component : equations.system->component) forces.data()[component] = 0.0;
  return forces;
}

Field assemble(const StageEquations& equations, const Field& displacement, double bonding,
               TangentTarget tangent, ElasticPart elastic) {
  const EquilibriumSystem& system = *equations.system;
  const Coefficients& with = *equations.coefficients;
  const bool at_rest = elastic == ElasticPart::at_rest;
  Field forces = equations.load;
  for (std::size_t i = 0; i < static_cast<std::size_t>(system.pattern.nonZeros()); ++i)
    tangent.first[i * tangent.stride] = at_rest ? with.elastic[i] : 0.0;
  if (at_rest)
    subtract_triangle_forces(equations, displacement, forces);
  else
    for_present_triangles(equations, [&](std::size_t t, std::size_t block) {
      const auto& nodes = system.structure->mesh.triangles[t].nodes;
      const TriangleResponse response =
          triangle_response(system.triangles[t], with.moduli[block], with.thickness[block],
                            gathered(displacement, nodes), equations.heat[block]);
      subtract_at(forces, nodes, response.force);
      add_local(system.triangle_slots[t], response.tangent, tangent);
    });
  for_present_joints(equations, [&](const Joint& joint, std::size_t j) {
    const Vector8d q = gathered(displacement, corners(joint));
    const JointKinematics kinematics = joint_kinematics(system.joints[j], q);
    JointResponse response = joint_response(equations, j, kinematics.state);
    subtract_at(forces, corners(joint), corner_forces(system.joints[j], kinematics, response.force));
    if (bonding > 0.0)
      response.tangent = (1.0 - bonding) * response.tangent + bonding * bonded_joint_tangent(with.joints[j]);
    Matrix8d stiffness = joint_geometric_stiffness(system.joints[j], q, kinematics, response.force);
    const Eigen::Matrix<double, 4, 8> turned = response.tangent.lazyProduct(kinematics.gradient);
    stiffness += kinematics.gradient.transpose().lazyProduct(turned);
    add_local(system.joint_slots[j], stiffness, tangent);
  });
  subtract_drag(equations, displacement, forces);
  add_stiffness_of_drag(equations, tangent);
  pin_removed(equations, tangent);
  clear_held(system, forces);
  return forces;
}

JointResponse joint_response(const StageEquations& equations, std::size_t joint, const JointState& state) {
  const Coefficients& with = *equations.coefficients;
  const JointMemory& memory = equations.memory[joint];
  if (const CohesiveStiffness* mortar = with.mortar_of(joint)) return integrate_bond(*mortar, memory, state);
  return integrate_joint(with.joints[joint], memory, state, equations.system->joint_rule);
}

std::vector<JointMemory> updated_memory(const StageEquations& equations, const Field& displacement) {
  const EquilibriumSystem& system = *equations.system;
  std::vector<JointMemory> memory = equations.memory;
  for_present_joints(equations, [&](const Joint& joint, std::size_t j) {
    const JointState state = joint_pose(system.joints[j], gathered(displacement, corners(joint))).state;
    if (const CohesiveStiffness* mortar = equations.coefficients->mortar_of(j))
      memory[j] = updated_bond(*mortar, memory[j], state);
    else
      memory[j] = updated_memory(equations.coefficients->joints[j], memory[j], state);
  });
  return memory;
}

Field admissible(const StageEquations& equations, const Field& field) {
  const EquilibriumSystem& system = *equations.system;
  Field result = without_nan(field);
  for (std::size_t c = 0; c < system.unknown.size(); ++c)
    if (system.unknown[c] < 0)
      result.data()[c] = equations.support_movement.size() > 0 ? equations.support_movement.data()[c] : 0.0;
  fill_removed(equations, 0.0, result);
  return result;
}

std::vector<bool> removal_mask(const Scene& scene, std::size_t block_count) {
  std::vector<bool> removed(block_count, false);
  for (const BlockId block : scene.removed) removed[static_cast<std::size_t>(value(block))] = true;
  return removed;
}

double unbalanced_force(const StageEquations& equations, const Field& displacement) {
  const Field clean = without_nan(displacement);
  return unbalanced_forces(equations, clean).cwiseAbs().maxCoeff() / equations.largest_load;
}

double unbalanced_force(const Model& model, const Scene& scene, const Field& displacement,
                        const Eigen::Matrix2Xd& slipped) {
  const EquilibriumSystem system(model);
  const Coefficients coefficients(system, model.parameters);
  return unbalanced_force(StageEquations(system, coefficients, {.scene = scene}, memory_of_slip(slipped)),
                          displacement);
}

}  // namespace voussoir
