#pragma once
/// @file A block in motion: a rigid frame, and a small elastic deformation in it that is stepped implicitly.
///
/// Symbols: nodes i of a block at X_i relative to its centre of mass at rest, lumped masses m_i, M their
/// diagonal matrix, K the stiffness of the block's triangles at rest. In motion node i is at c + R (X_i +
/// u_i), with the centre c, the rotation R and the deformation u, which has no part that moves the block as a
/// whole.
///
///   centre and rotation:  central differences under the resultant and the moment of all forces
///   deformation:          (M + dt^2 K) u_new = M (u + dt du/dt) + dt^2 R^T f
///
/// The deformation's own vibrations (hundreds of hertz and more) are damped by the step, its response to slow
/// forces is exact, and the stable step is set by the joints alone. A block held by a support does not turn:
/// its frame stays where it is and u is its whole displacement.

#include <Eigen/Core>
#include <vector>

#include "core/structure/model.h"

namespace voussoir {

/// Which moment of inertia turns a block.
enum class RotationalInertia {
  exact,  ///< of its area and of what is laid on its nodes: how blocks rock and topple
  lumped  ///< of the masses lumped at its nodes, up to three times as much for a block of two triangles.
          ///< Central differences on the nodes move like that, and where only the state of rest counts it
          ///< allows steps half as large again
};

struct BlockBody {
  IndexRange nodes;
  double mass = 0.0;          ///< [kg]
  double inertia = 0.0;       ///< moment of inertia about the centre [kg m2]
  Point centre;               ///< of mass, at rest [m]
  bool held = false;          ///< a support holds some of its nodes
  bool free_x = true;         ///< no node is held in x, so that all horizontal forces on it must balance
  bool free_y = true;         ///< the same for y
  Eigen::VectorXd masses;     ///< of each component (2 per node) [kg]
  Eigen::VectorXd arms;       ///< X, component by component [m]
  Eigen::MatrixXd stiffness;  ///< K [N/m]
  std::vector<bool> held_components;
};

/// The bodies of all blocks.
std::vector<BlockBody> make_block_bodies(const Model& model, RotationalInertia inertia);

/// Lumped masses of the nodes, with what is laid on them [kg].
Eigen::VectorXd lumped_masses(const Model& model);

/// (M + dt^2 K)^-1 with zero rows and columns at held components: the acceleration that a force gives the
/// nodes during an implicit step, with lumped masses throughout [1/kg].
Eigen::MatrixXd step_response(const BlockBody& body, double step);

/// The same without the motion of the block as a whole, which a free block's frame makes: what the
/// deformation takes.
Eigen::MatrixXd deformation_response(const BlockBody& body, double step);

/// The acceleration that forces that turn round in every step give the nodes of a block in motion, frame and
/// deformation together [1/kg]: what stability is judged by. Where x turns into -x,
/// (M + dt^2 K) x_new - 2 M x + M x_old = dt^2 f  says  (4 M + dt^2 K) x = -dt^2 f: the deformation responds
/// with the elasticity of half a step.
Eigen::MatrixXd alternating_response(const BlockBody& body, double step);

}  // namespace voussoir
