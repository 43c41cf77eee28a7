#pragma once
/// @file The chi square distribution: how likely a sum of squares is.

#include <boost/math/special_functions/gamma.hpp>

namespace voussoir {

/// The chance that the sum of the squares of so many independent standard normals is at least as large.
inline double chi_square_chance(double square, double count) {
  return boost::math::gamma_q(0.5 * count, 0.5 * square);
}

}  // namespace voussoir
