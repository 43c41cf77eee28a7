#pragma once
/// @file What is there while a bridge finds its equilibrium.

#include "core/structure/mesh.h"
#include "core/structure/scene.h"

namespace voussoir {

struct Stage {
  Scene scene{};               ///< which blocks are missing
  double gravity_share = 1.0;  ///< of the parameters' gravity
  Field load{};  ///< forces on the nodes beside the weight [N], 2 x nodes, of fixed direction; empty: none
};

}  // namespace voussoir
