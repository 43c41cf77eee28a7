#include "core/law/joint_law.h"

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

StretchMass mass_of(const StretchContact& contact, const PositivePart<double>& part) {
  const double begin = contact.closed.begin + part.begin;
  return mass_of_part(begin, begin + part.length);
}

}  // namespace

JointStiffness joint_stiffness(const JointMaterial& material, double area) {
  return {.normal = area * material.normal_stiffness,
          .tangential = area * material.tangential_stiffness,
          .cap = area * material.friction_coefficient() * material.normal_stiffness};
}

JointResponse integrate_joint(const JointStiffness& joint, const JointMemory& memory,
                              const JointState& state) {
  const JointState elastic_state = elastic(state, memory);
  JointResponse response{Eigen::Vector4d::Zero(), Eigen::Matrix4d::Zero()};
  if (state[0] >= 0.0 && state[2] >= 0.0) return response;
  const StretchContact contact = contact_of(joint, elastic_state);
  const StretchMass closed = mass_of_part(contact.closed.begin, contact.end());
  const StretchMass above = mass_of(contact, contact.excess.above);
  const StretchMass below = mass_of(contact, contact.excess.below);
  add_mass(response.tangent, closed, 0, 0, joint.normal);
  add_mass(response.tangent, closed - above - below, 1, 1, joint.tangential);
  add_mass(response.tangent, below - above, 1, 0, joint.cap);
  response.force = response.tangent * elastic_state;  // stresses are homogeneous in gap and elastic slip
  return response;
}

JointMemory updated_memory(const JointStiffness& joint, const JointMemory& memory, const JointState& state) {
  if (state[0] >= 0.0 && state[2] >= 0.0) return {state[1], state[3]};
  const double plastic = contact_of(joint, elastic(state, memory)).excess.common / joint.tangential;
  return {memory.slip_0 + plastic, memory.slip_1 + plastic};
}

JointForceParts joint_force_parts(const JointStiffness& joint, const JointMemory& memory,
                                  const JointState& state) {
  const JointState elastic_state = elastic(state, memory);
  JointForceParts parts{Eigen::Vector4d::Zero(), Eigen::Vector4d::Zero(), Eigen::Vector4d::Zero()};
  if (state[0] >= 0.0 && state[2] >= 0.0) return parts;
  const StretchContact contact = contact_of(joint, elastic_state);
  const StretchMass closed = mass_of_part(contact.closed.begin, contact.end());
  const StretchMass above = mass_of(contact, contact.excess.above);
  const StretchMass below = mass_of(contact, contact.excess.below);
  const auto force = [&](const StretchMass& mass, int row, int column, double coefficient) {
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
    add_mass(matrix, mass, row, column, coefficient);
    return Eigen::Vector4d(matrix * elastic_state);
  };
  return {force(closed, 0, 0, joint.normal), force(closed - above - below, 1, 1, joint.tangential),
          force(below - above, 1, 0, joint.cap)};
}

JointContact joint_contact(const JointStiffness& joint, const JointMemory& memory, const JointState& state) {
  const StretchContact contact = contact_of(joint, elastic(state, memory));
  return {contact.closed.length, contact.excess.above.length + contact.excess.below.length};
}

MemoryDerivatives memory_derivatives(const JointStiffness& joint, const JointMemory& memory,
                                     const JointState& state) {
  MemoryDerivatives result;
  if (state[0] >= 0.0 && state[2] >= 0.0) {
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
