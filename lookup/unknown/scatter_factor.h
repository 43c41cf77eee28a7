#pragma once
/// @file How far the scatter of a bridge's parameters may be off from what its file states.

#include <array>

namespace voussoir {

/// The variance of the bridge's parameters is one of these times what the file states: standard deviations of
/// half to twice it, in three equal steps of the logarithm. Tests of a dozen joints or blocks tell a standard
/// deviation no better.
inline constexpr std::array<double, 4> kScatterFactors = {0.25, 0.62996052494743658, 1.5874010519681994, 4.0};

/// Beforehand: the ends are half as likely as what lies between.
inline constexpr std::array<double, 4> kScatterPrior = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};

}  // namespace voussoir
