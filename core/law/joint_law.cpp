#include "core/law/joint_law.h"

#include <array>

#include "core/law/stretch_mass.h"

namespace voussoir {
namespace {

/// The closed part of a stretch of length 1 and what friction does there.
struct StretchContact {
  PositivePart<double> closed;  ///< of the penetration
  FrictionExcess<double> excess;
  double end() const { return closed.begin + closed.length; }
};

/// Elastic slip in the place of the slip.
JointState elastic(const JointState& state, const JointMemory& memory) {
  return {state[0], state[1] - memory.slip_0, state[2], state[3] - memory.slip_1};
}

/// `state` holds elastic slips.
StretchContact contact_of(const JointStiffness& joint, const JointState& state) {
  StretchContact contact;
  contact.closed = positive_part<double>(1.0, -state[0], -state[2]);
  const auto along = [](double at_0, double at_1, double s) { return at_0 + s * (at_1 - at_0); };
  const double begin = contact.closed.begin;
  const auto tau = [&](double s) { return joint.tangential * along(state[1], state[3], s); };
  const auto cap = [&](double s) { return joint.cap * larger(0.0, -along(state[0], state[2], s)); };
  contact.excess = friction_excess<double>(contact.closed.length, tau(begin), tau(contact.end()), cap(begin),
                                           cap(contact.end()));
  return contact;
}

/// Over what parts of a stretch stresses go with which state.
struct StretchMasses {
  StretchMass closed, sticking;
  StretchMass slipping;  ///< where it slips in the negative direction less where in the positive
};

/// Is the whole stretch closed, and does it stick? As most are.
bool sticks(const JointStiffness& joint, const JointState& state) {
  const auto holds = [&](double gap, double slip) {
    return gap < 0.0 && joint.tangential * magnitude(slip) <= -joint.cap * gap;
  };
  return holds(state[0], state[1]) && holds(state[2], state[3]);
}

/// `state` holds elastic slips.
StretchMasses masses_of(const JointStiffness& joint, const JointState& state) {
  if (sticks(joint, state)) return {kWholeStretch, kWholeStretch, {}};
  const StretchContact contact = contact_of(joint, state);
  const auto of_part = [&](const PositivePart<double>& part) {
    const double begin = contact.closed.begin + part.begin;
    return mass_of_part(begin, begin + part.length);
  };
  const StretchMass closed = mass_of_part(contact.closed.begin, contact.end());
  const StretchMass above = of_part(contact.excess.above), below = of_part(contact.excess.below);
  return {closed, closed - above - below, below - above};
}

/// Stresses are homogeneous in gap and elastic slip. `state` holds elastic slips.
JointForceParts parts_of(const JointStiffness& joint, const StretchMasses& masses, const JointState& state) {
  const auto product = [&](const StretchMass& mass, int column, double coefficient) {
    const double at_0 = coefficient * state[column], at_1 = coefficient * state[column + 2];
    return std::array{mass.m00 * at_0 + mass.m01 * at_1, mass.m01 * at_0 + mass.m11 * at_1};
  };
  const auto normal = product(masses.closed, 0, joint.normal);
  const auto sticking = product(masses.sticking, 1, joint.tangential);
  const auto slipping = product(masses.slipping, 0, joint.cap);
  return {.normal = {normal[0], 0.0, normal[1], 0.0},
          .sticking = {0.0, sticking[0], 0.0, sticking[1]},
          .slipping = {0.0, slipping[0], 0.0, slipping[1]}};
}

bool is_open(const JointState& state) {
  return state[0] >= 0.0 && state[2] >= 0.0;
}

}  // namespace

JointStiffness joint_stiffness(const JointMaterial& material, double area) {
  return {.normal = area * material.normal_stiffness,
          .tangential = area * material.tangential_stiffness,
          .cap = area * material.friction_coefficient() * material.normal_stiffness};
}

JointResponse integrate_joint(const JointStiffness& joint, const JointMemory& memory,
                              const JointState& state) {
  JointResponse response{Eigen::Vector4d::Zero(), Eigen::Matrix4d::Zero()};
  if (is_open(state)) return response;
  const JointState elastic_state = elastic(state, memory);
  const StretchMasses masses = masses_of(joint, elastic_state);
  add_mass(response.tangent, masses.closed, 0, 0, joint.normal);
  add_mass(response.tangent, masses.sticking, 1, 1, joint.tangential);
  add_mass(response.tangent, masses.slipping, 1, 0, joint.cap);
  response.force = parts_of(joint, masses, elastic_state).sum();
  return response;
}

Eigen::Vector4d joint_force(const JointStiffness& joint, const JointMemory& memory, const JointState& state) {
  return joint_force_parts(joint, memory, state).sum();
}

JointMemory updated_memory(const JointStiffness& joint, const JointMemory& memory, const JointState& state) {
  if (is_open(state)) return {state[1], state[3]};
  const double plastic = contact_of(joint, elastic(state, memory)).excess.common / joint.tangential;
  return {memory.slip_0 + plastic, memory.slip_1 + plastic};
}

JointForceParts joint_force_parts(const JointStiffness& joint, const JointMemory& memory,
                                  const JointState& state) {
  if (is_open(state)) return {Eigen::Vector4d::Zero(), Eigen::Vector4d::Zero(), Eigen::Vector4d::Zero()};
  const JointState elastic_state = elastic(state, memory);
  return parts_of(joint, masses_of(joint, elastic_state), elastic_state);
}

JointContact joint_contact(const JointStiffness& joint, const JointMemory& memory, const JointState& state) {
  const StretchContact contact = contact_of(joint, elastic(state, memory));
  return {contact.closed.length, contact.excess.above.length + contact.excess.below.length};
}

MemoryDerivatives memory_derivatives(const JointStiffness& joint, const JointMemory& memory,
                                     const JointState& state) {
  MemoryDerivatives result;
  if (is_open(state)) {
    result.by_state(0, 1) = result.by_state(1, 3) = 1.0;
    result.by_memory.setZero();
    return result;
  }
  const JointState x = elastic(state, memory);
  const StretchContact contact = contact_of(joint, x);
  if (contact.excess.common == 0.0) return result;
  // The plastic slip is xi(s) + bound gap(s) at that end s of the closed part where the excess is smaller.
  const double sign = contact.excess.common > 0.0 ? 1.0 : -1.0;
  const double bound = sign * joint.cap / joint.tangential;
  const auto slip = [&](double s) { return x[1] + s * (x[3] - x[1]) + bound * (x[0] + s * (x[2] - x[0])); };
  const bool at_begin = sign * slip(contact.closed.begin) < sign * slip(contact.end());
  const double s = at_begin ? contact.closed.begin : contact.end();
  Eigen::RowVector4d plastic(0.0, 1.0 - s, 0.0, s);
  if (state[at_begin ? 0 : 2] < 0.0) {
    plastic[0] = bound * (1.0 - s);
    plastic[2] = bound * s;
    const double way = bound * (x[0] + s * (x[2] - x[0]));
    result.by_friction.setConstant(way);
    result.by_ratio.setConstant(-way);
  } else {  // the closed part ends where the gap is zero, s = gap_0 / (gap_0 - gap_1)
    const double difference = x[0] - x[2];
    plastic[0] = -(x[3] - x[1]) * x[2] / (difference * difference);
    plastic[2] = (x[3] - x[1]) * x[0] / (difference * difference);
  }
  result.by_state.rowwise() = plastic;
  result.by_memory.rowwise() -= Eigen::RowVector2d(1.0 - s, s);
  return result;
}

Eigen::Matrix4d bonded_joint_tangent(const JointStiffness& joint) {
  const StretchMass whole = mass_of_part(0.0, 1.0);
  Eigen::Matrix4d tangent = Eigen::Matrix4d::Zero();
  add_mass(tangent, whole, 0, 0, joint.normal);
  add_mass(tangent, whole, 1, 1, joint.tangential);
  return tangent;
}

}  // namespace voussoir
