#include "core/statics/parameter_derivatives.h"

#include <algorithm>

#include "core/statics/elements.h"

namespace voussoir {
namespace {

using Entries = std::vector<Eigen::Triplet<double>>;

ColumnMatrix matrix_of(Eigen::Index rows, Eigen::Index columns, const Entries& entries) {
  ColumnMatrix matrix(rows, columns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// Adds local forces at the components that are free.
template <std::size_t N, class Vector>
void add_forces(const EquilibriumSystem& system, const std::array<NodeId, N>& nodes, const Vector& local,
                Eigen::Index column, Entries& entries) {
  const auto places = components(nodes);
  for (std::size_t i = 0; i < places.size(); ++i)
    if (system.unknown[static_cast<std::size_t>(places[i])] >= 0)
      entries.emplace_back(places[i], static_cast<int>(column), local[static_cast<int>(i)]);
}

JointKinematics kinematics_of(const StageEquations& equations, const Field& displacement, const Joint& joint,
                              std::size_t j) {
  return joint_kinematics(equations.system->joints[j], gathered(displacement, corners(joint)));
}

/// Forces of a joint on its corners, by what they come from.
struct CornerForces {
  Vector8d normal = Vector8d::Zero();
  Vector8d sticking = Vector8d::Zero();
  Vector8d slipping = Vector8d::Zero();
};

std::vector<CornerForces> forces_of_joints(const StageEquations& equations, const Field& displacement) {
  std::vector<CornerForces> forces(equations.system->joints.size());
  for_present_joints(equations, [&](const Joint& joint, std::size_t j) {
    const JointKinematics kinematics = kinematics_of(equations, displacement, joint, j);
    const JointForceParts parts =
        joint_force_parts(equations.coefficients->joints[j], equations.memory[j], kinematics.state);
    const auto turned = [&](const Eigen::Vector4d& force) {
      return Vector8d(kinematics.gradient.transpose() * force);
    };
    forces[j] = {turned(parts.normal), turned(parts.sticking), turned(parts.slipping)};
  });
  return forces;
}

/// Derivative of a joint's forces by the logarithm of a quantity of its own.
Vector8d derivative(const CornerForces& forces, UncertainQuantity quantity) {
  switch (quantity) {
    case UncertainQuantity::stiffness:
      return forces.normal + forces.sticking + forces.slipping;
    case UncertainQuantity::stiffness_ratio:
      return forces.sticking;
    case UncertainQuantity::friction:
      return forces.slipping;
    default:
      return Vector8d::Zero();
  }
}

void add_weight(const StageEquations& equations, double sigma, Eigen::Index column, Entries& entries) {
  const EquilibriumSystem& system = *equations.system;
  const Mesh& mesh = system.structure->mesh;
  for (std::size_t block = 0; block < equations.removed.size(); ++block) {
    if (equations.removed[block]) continue;
    for (int node = mesh.block_nodes[block].begin; node < mesh.block_nodes[block].end; ++node)
      if (system.unknown[static_cast<std::size_t>(2 * node + 1)] >= 0)
        entries.emplace_back(2 * node + 1, static_cast<int>(column),
                             -sigma * equations.gravity_share * equations.coefficients->weight[node]);
  }
}

void add_modulus(const StageEquations& equations, const Field& displacement, double sigma,
                 Eigen::Index column, Entries& entries) {
  const EquilibriumSystem& system = *equations.system;
  const Coefficients& with = *equations.coefficients;
  for_present_triangles(equations, [&](std::size_t t, std::size_t block) {
    const auto& nodes = system.structure->mesh.triangles[t].nodes;
    add_forces(
        system, nodes,
        Vector6d(-sigma * triangle_force(system.triangles[t], with.moduli[block], with.thickness[block],
                                         gathered(displacement, nodes), equations.heat[block])),
        column, entries);
  });
}

/// Without stiffness a triangle's forces are those of the heat alone.
void add_temperature(const StageEquations& equations, const Field& displacement,
                     const UncertainAction& action, Eigen::Index column, Entries& entries) {
  constexpr PlaneModuli kNone{0.0, 0.0, 0.0};
  const EquilibriumSystem& system = *equations.system;
  const Coefficients& with = *equations.coefficients;
  for_present_triangles(equations, [&](std::size_t t, std::size_t block) {
    if (!action.blocks.empty() && !std::ranges::binary_search(action.blocks, block)) return;
    const auto& nodes = system.structure->mesh.triangles[t].nodes;
    add_forces(system, nodes,
               Vector6d(-action.parameter.sigma *
                        triangle_force(system.triangles[t], kNone, with.thickness[block],
                                       gathered(displacement, nodes), with.thermal[block])),
               column, entries);
  });
}

/// What held components that move do to the free ones.
void add_movement(const StageEquations& equations, const Field& displacement, const Field& movement,
                  Eigen::Index column, Entries& entries) {
  const EquilibriumSystem& system = *equations.system;
  const Coefficients& with = *equations.coefficients;
  for_present_triangles(equations, [&](std::size_t t, std::size_t block) {
    const auto& nodes = system.structure->mesh.triangles[t].nodes;
    const Vector6d local = gathered(movement, nodes);
    if (local.isZero(0.0)) return;
    const TriangleResponse response =
        triangle_response(system.triangles[t], with.moduli[block], with.thickness[block],
                          gathered(displacement, nodes), equations.heat[block]);
    add_forces(system, nodes, Vector6d(-response.tangent * local), column, entries);
  });
  for_present_joints(equations, [&](const Joint& joint, std::size_t j) {
    const Vector8d local = gathered(movement, corners(joint));
    if (local.isZero(0.0)) return;
    const Vector8d q = gathered(displacement, corners(joint));
    const JointKinematics kinematics = joint_kinematics(system.joints[j], q);
    const JointResponse response =
        integrate_joint(with.joints[j], equations.memory[j], kinematics.state, system.joint_rule);
    const Vector8d force =
        kinematics.gradient.transpose() * (response.tangent * (kinematics.gradient * local)) +
        joint_geometric_stiffness(system.joints[j], q, kinematics, response.force) * local;
    add_forces(system, corners(joint), Vector8d(-force), column, entries);
  });
}

/// The places of a joint's memory.
std::array<int, 2> memory_of(std::size_t joint) {
  return {static_cast<int>(2 * joint), static_cast<int>(2 * joint + 1)};
}

}  // namespace

ColumnMatrix forces_by_parameters(const StageEquations& equations, const Field& displacement,
                                  const UncertainParameters& uncertain, const ColumnMatrix& movements) {
  const EquilibriumSystem& system = *equations.system;
  const std::vector<CornerForces> joints = forces_of_joints(equations, displacement);
  Entries entries;
  Eigen::Index column = 0;
  const auto add_action = [&](const UncertainAction& action) {
    const double sigma = action.parameter.sigma;
    for (const std::size_t j : action.joints)
      add_forces(system, corners(system.structure->joints[j]),
                 Vector8d(-sigma * derivative(joints[j], action.quantity)), column, entries);
    if (action.quantity == UncertainQuantity::density) add_weight(equations, sigma, column, entries);
    if (action.quantity == UncertainQuantity::young_modulus)
      add_modulus(equations, displacement, sigma, column, entries);
    if (action.quantity == UncertainQuantity::temperature)
      add_temperature(equations, displacement, action, column, entries);
  };
  for (const UncertainAction& action : uncertain.of_bridge) {
    add_action(action);
    ++column;
  }
  for (std::size_t i = 0; i < uncertain.of_epoch.size(); ++i) {
    add_action(uncertain.of_epoch[i]);
    add_movement(
        equations, displacement,
        Eigen::VectorXd(movements.col(static_cast<Eigen::Index>(i))).reshaped(2, movements.rows() / 2),
        column, entries);
    ++column;
  }
  return matrix_of(displacement.size(), column, entries);
}

ColumnMatrix forces_by_memory(const StageEquations& equations, const Field& displacement) {
  const EquilibriumSystem& system = *equations.system;
  Entries entries;
  for_present_joints(equations, [&](const Joint& joint, std::size_t j) {
    const JointKinematics kinematics = kinematics_of(equations, displacement, joint, j);
    const JointResponse response = integrate_joint(equations.coefficients->joints[j], equations.memory[j],
                                                   kinematics.state, system.joint_rule);
    for (const int end : {0, 1})  // memory acts as less slip
      add_forces(system, corners(joint),
                 Vector8d(kinematics.gradient.transpose() * response.tangent.col(2 * end + 1)),
                 memory_of(j)[static_cast<std::size_t>(end)], entries);
  });
  return matrix_of(displacement.size(), static_cast<Eigen::Index>(2 * system.joints.size()), entries);
}

MemoryJacobian memory_jacobian(const StageEquations& equations, const Field& displacement,
                               const UncertainParameters& uncertain) {
  const EquilibriumSystem& system = *equations.system;
  Entries by_displacement, by_memory, by_parameters;
  std::vector<MemoryDerivatives> derivatives(system.joints.size());
  for_present_joints(equations, [&](const Joint& joint, std::size_t j) {
    const JointKinematics kinematics = kinematics_of(equations, displacement, joint, j);
    derivatives[j] =
        memory_derivatives(equations.coefficients->joints[j], equations.memory[j], kinematics.state);
    if (derivatives[j].by_state.isZero(0.0)) return;
    const Eigen::Matrix<double, 2, 8> turned = derivatives[j].by_state * kinematics.gradient;
    const auto places = components(corners(joint));
    for (int end = 0; end < 2; ++end)
      for (std::size_t i = 0; i < places.size(); ++i)
        by_displacement.emplace_back(memory_of(j)[static_cast<std::size_t>(end)], places[i],
                                     turned(end, static_cast<int>(i)));
  });
  for (std::size_t j = 0; j < derivatives.size(); ++j)
    for (int end = 0; end < 2; ++end)
      for (int other = 0; other < 2; ++other)
        by_memory.emplace_back(memory_of(j)[static_cast<std::size_t>(end)],
                               memory_of(j)[static_cast<std::size_t>(other)],
                               derivatives[j].by_memory(end, other));
  int column = 0;
  for (const UncertainAction& action : uncertain.of_bridge) {
    const bool is_friction = action.quantity == UncertainQuantity::friction;
    if (is_friction || action.quantity == UncertainQuantity::stiffness_ratio)
      for (const std::size_t j : action.joints)
        for (int end = 0; end < 2; ++end)
          by_parameters.emplace_back(memory_of(j)[static_cast<std::size_t>(end)], column,
                                     action.parameter.sigma * (is_friction ? derivatives[j].by_friction[end]
                                                                           : derivatives[j].by_ratio[end]));
    ++column;
  }
  const auto ends = static_cast<Eigen::Index>(2 * system.joints.size());
  const auto parameters = static_cast<Eigen::Index>(uncertain.of_bridge.size() + uncertain.of_epoch.size());
  return {matrix_of(ends, displacement.size(), by_displacement), matrix_of(ends, ends, by_memory),
          matrix_of(ends, parameters, by_parameters)};
}

}  // namespace voussoir
