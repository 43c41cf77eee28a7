#pragma once
/// @file Stresses in the blocks at an equilibrium.

#include <limits>
#include <vector>

#include "core/statics/equilibrium.h"

namespace voussoir {

/// Stresses of a triangle [Pa]; tension is positive. NaN where the block is gone.
struct TriangleStress {
  double xx = std::numeric_limits<double>::quiet_NaN();
  double yy = xx;
  double xy = xx;
  double zz = xx;      ///< out of plane: zero in plane stress
  double tresca = xx;  ///< largest less smallest principal stress, that out of plane among them
};

/// Cauchy stresses of every triangle, at the temperature at which the bridge was built. `parameters` are
/// those that the equations' coefficients come from.
std::vector<TriangleStress> triangle_stresses(const StageEquations& equations, const Parameters& parameters,
                                              const Field& displacement);

}  // namespace voussoir
