#pragma once
/// @file Integrals of products of the two linear shape functions of a stretch, N_0 = 1 - s and N_1 = s.

#include <Eigen/Core>

namespace voussoir {

/// Integrals of N_k N_l over a part of the stretch.
struct StretchMass {
  double m00 = 0.0, m01 = 0.0, m11 = 0.0;
};

inline constexpr StretchMass kWholeStretch = {1.0 / 3.0, 1.0 / 6.0, 1.0 / 3.0};

inline StretchMass mass_of_part(double a, double b) {
  const double squares = b * b - a * a;
  const double cubes = b * b * b - a * a * a;
  return {(b - a) - squares + cubes / 3.0, squares / 2.0 - cubes / 3.0, cubes / 3.0};
}

inline StretchMass mass_of_point(double s, double weight) {
  return {weight * (1.0 - s) * (1.0 - s), weight * s * (1.0 - s), weight * s * s};
}

inline StretchMass operator-(const StretchMass& a, const StretchMass& b) {
  return {a.m00 - b.m00, a.m01 - b.m01, a.m11 - b.m11};
}

/// Adds coefficient * N_k N_l to the tangent block (force component `row`, state component `column`; 0 gap, 1
/// slip).
inline void add_mass(Eigen::Matrix4d& tangent, const StretchMass& mass, int row, int column,
                     double coefficient) {
  tangent(row, column) += coefficient * mass.m00;
  tangent(row, column + 2) += coefficient * mass.m01;
  tangent(row + 2, column) += coefficient * mass.m01;
  tangent(row + 2, column + 2) += coefficient * mass.m11;
}

}  // namespace voussoir
