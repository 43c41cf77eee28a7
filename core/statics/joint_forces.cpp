#include "core/statics/joint_forces.h"

#include <algorithm>

#include "core/statics/elements.h"

namespace voussoir {
namespace {

/// Shares of a stretch that differ by less are alike: rounding.
constexpr double kNearlyAll = 1e-9;

JointCondition condition_of(const JointContact& contact) {
  if (contact.closed <= 0.0) return JointCondition::open;
  return contact.sliding >= (1.0 - kNearlyAll) * contact.closed ? JointCondition::sliding
                                                                : JointCondition::sticking;
}

JointContact contact_of(const StageEquations& equations, std::size_t joint, const JointState& state) {
  const Coefficients& with = *equations.coefficients;
  const JointMemory& memory = equations.memory[joint];
  if (const CohesiveStiffness* mortar = with.mortar_of(joint)) return bond_contact(*mortar, memory, state);
  return joint_contact(with.joints[joint], memory, state);
}

/// [Pa]
double pressure_at(const StageEquations& equations, std::size_t joint, double normal_stiffness,
                   const JointState& state, int end) {
  const Coefficients& with = *equations.coefficients;
  const CohesiveStiffness* mortar = with.mortar_of(joint);
  if (mortar == nullptr) return normal_stiffness * std::max(0.0, -state[2 * end]);
  return bond_pressure(*mortar, equations.memory[joint], state, end) / mortar->dry.normal * normal_stiffness;
}

/// The force along the joint as it has turned: `force` is (along the normal, along the joint) [N]. Gap and
/// slip of an end change with a movement of the second block by just these directions.
Point pulled_by(const JointKinematics& kinematics, const Eigen::Vector2d& force) {
  const Eigen::Matrix<double, 2, 8> rows = kinematics.gradient.topRows<2>();
  return (rows.middleCols<2>(4) + rows.middleCols<2>(6)).transpose() * force;
}

}  // namespace

std::string_view to_string(JointCondition condition) {
  constexpr std::array<std::string_view, 3> kNames = {"open", "sticking", "sliding"};
  return kNames.at(static_cast<std::size_t>(condition));
}

std::vector<JointForces> joint_forces(const StageEquations& equations, const Parameters& parameters,
                                      const Field& displacement) {
  const EquilibriumSystem& system = *equations.system;
  std::vector<JointForces> result;
  for_present_joints(equations, [&](const Joint& joint, std::size_t j) {
    const JointKinematics kinematics =
        joint_kinematics(system.joints[j], gathered(displacement, corners(joint)));
    const JointState& state = kinematics.state;
    const Eigen::Vector4d force = joint_response(equations, j, state).force;
    const JointContact contact = contact_of(equations, j, state);
    JointForces& found = result.emplace_back();
    found.joint = j;
    found.ends = ends_of(joint, system.structure->mesh);
    found.gap = {state[0], state[2]};
    found.slip = {state[1], state[3]};
    for (int end = 0; end < 2; ++end)
      found.pressure.at(static_cast<std::size_t>(end)) =
          pressure_at(equations, j, parameters.joints[j].normal_stiffness, state, end);
    found.normal = 0.0 - force[0] - force[2];
    found.shear = force[1] + force[3];
    for (int end = 0; end < 2; ++end)
      found.on_second.at(static_cast<std::size_t>(end)) = -pulled_by(kinematics, force.segment<2>(2 * end));
    found.closed_share = contact.closed;
    found.sliding_share = contact.sliding;
    found.condition = condition_of(contact);
  });
  return result;
}

}  // namespace voussoir
