#pragma once
/// @file Joints with mortar in motion: a bond holds two faces together in the frame of their joint at rest
/// (core/law/cohesive_law.h) until it is worn away. From then on they are in contact like any other faces.
///
/// A bond sees the places that its nodes will have a time `contact_damping` later, as contacts do, and
/// remembers these.

#include <array>
#include <vector>

#include "core/law/cohesive_law.h"
#include "core/law/joint_kinematics.h"
#include "core/motion/contact_search.h"

namespace voussoir {

struct BondedJoint {
  EdgePair pair;                      ///< its edges
  std::array<std::size_t, 2> blocks;  ///< on its two sides
  std::array<int, 4> nodes;           ///< of the first edge, then of the second
  JointFrame frame;
  CohesiveStiffness law;
};

/// The joints of a model that have mortar, in ascending order of their edges.
std::vector<BondedJoint> bonded_joints(const Model& model, const ContactSearch& search);

/// A bond in motion. `holds`: the faces are not in contact.
struct MortarBond {
  JointMemory memory{};
  bool holds = true;
};

/// What is left of a bond counts as nothing below this share of its strength, all along the joint.
inline constexpr double kBondGone = 1e-4;

/// Forces on the nodes of a bonded joint [N] at these displacements; the bond remembers them. Where mortar
/// was crushed the bond holds for good: it alone knows that the joint has become thinner.
Vector8d follow_bond(const BondedJoint& joint, const Vector8d& displacement, MortarBond& bond);

}  // namespace voussoir
