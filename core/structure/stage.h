#pragma once
/// @file What is there while a bridge finds its equilibrium.

#include "core/structure/mesh.h"
#include "core/structure/scene.h"

namespace voussoir {

struct Stage {
  Scene scene{};               ///< which blocks are missing
  double gravity_share = 1.0;  ///< of the parameters' gravity
  Field load{};  ///< forces on the nodes beside the weight [N], 2 x nodes, of fixed direction; empty: none
  double temperature = 0.0;             ///< of all blocks [K] over that at which the bridge was built
  Eigen::ArrayXd uneven_temperature{};  ///< of each block beyond that [K]; empty: none. Only Newton's method
                                        ///< (QuasiStaticSolver) knows of either
  Field
      support_movement{};  ///< displacements of the components that supports hold [m], 2 x nodes; empty: none
  Eigen::ArrayXd joint_stiffness{};  ///< share of the parameters' p_n and p_t of each joint; empty: all of
                                     ///< it. Only Newton's method (QuasiStaticSolver) follows what it does,
                                     ///< and only of dry joints
};

/// Of a block [K].
double temperature_of(const Stage& stage, std::size_t block);

/// The stage `to` on the way: all but the scene and (in their logarithms) the joints' stiffnesses have gone
/// this share of it from `from`.
Stage on_the_way(const Stage& from, Stage to, double share);

}  // namespace voussoir
