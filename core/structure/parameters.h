#pragma once
/// @file The numbers in which bridges of one structure differ.

#include <vector>

#include "core/structure/structure.h"

namespace voussoir {

/// Material of every block, law of every joint.
struct Parameters {
  double gravity = 9.81;              ///< [m/s2] downwards
  std::vector<Material> blocks;       ///< of each block of the structure
  std::vector<JointMaterial> joints;  ///< of each joint of the structure
  JointMaterial contact;              ///< where blocks meet that did not touch at rest
  std::vector<double> contact_share;  ///< [-] of each block: where it meets another newly, stiffness is the
                                      ///< smaller share of the two of `contact`; empty: all of it
};

/// The same material everywhere, as a bridge file states it.
Parameters uniform_parameters(const Structure& structure, const Material& material,
                              const JointMaterial& joints, double gravity);

/// The joint with this share of both its stiffnesses and all of its friction.
JointMaterial softened(JointMaterial joint, double share);

/// How deep the joint is out of plane: as deep as the thinner of its blocks [m].
double joint_thickness(const Joint& joint, const Parameters& parameters);

}  // namespace voussoir
