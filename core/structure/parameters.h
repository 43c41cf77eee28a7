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
  Eigen::VectorXd laid_mass{};        ///< [kg] of soil on each node beside its block's mass; empty: none
  JointMaterial contact;              ///< where blocks meet that did not touch at rest: dry
  std::vector<double> contact_share;  ///< [-] of each block: where it meets another newly, stiffness is the
                                      ///< smaller share of the two of `contact`; empty: all of it
};

/// The same material everywhere, as a bridge file states it.
Parameters uniform_parameters(const Structure& structure, const Material& material,
                              const JointMaterial& joints, double gravity);

/// The joint with this share of both its stiffnesses and all of its friction.
JointMaterial softened(JointMaterial joint, double share);

/// Where blocks meet that did not touch at rest, if joints are `drawn` instead: changed as the median joint
/// is, each of its values by itself. Precondition: as many joints as `nominal` has.
JointMaterial drawn_contact(const std::vector<JointMaterial>& drawn, const Parameters& nominal);

/// Has any joint mortar?
bool has_mortar(const Parameters& parameters);

/// How deep the joint is out of plane: as deep as the thinner of its blocks [m].
double joint_thickness(const Joint& joint, const Parameters& parameters);

}  // namespace voussoir
