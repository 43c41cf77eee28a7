#pragma once
/// @file The constant-strain triangle in total Lagrangian form: any rotation, small strain.
///
/// Symbols: N_i linear shape functions, H = sum_i u_i (x) grad N_i displacement gradient, F = I + H,
/// E = (H + H^T + H^T H) / 2 Green strain, S = C : E second Piola-Kirchhoff stress (Saint Venant-Kirchhoff).

#include <Eigen/Core>

#include "core/structure/bridge_description.h"

namespace voussoir {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// Elastic moduli [Pa] of the plane state: S_xx = a E_xx + b E_yy, S_yy = b E_xx + a E_yy, S_xy = 2 g E_xy.
struct PlaneModuli {
  double a;
  double b;
  double g;
};

PlaneModuli plane_moduli(const Material& material);

/// Pressure of a material that is heated by one kelvin and cannot expand [Pa/K]. Its stress is that of the
/// strain less this pressure times the temperature, in both directions of the plane.
double thermal_pressure(const Material& material);

/// What an element needs of the reference configuration.
struct TriangleShape {
  Eigen::Matrix<double, 2, 3> gradient;  ///< column i: grad N_i [1/m]
  double area;                           ///< [m2]
};

/// Precondition: corners counter-clockwise.
TriangleShape triangle_shape(const Point& a, const Point& b, const Point& c);

struct TriangleResponse {
  Vector6d force;    ///< internal forces on the corners (x0,y0,..) [N]
  Matrix6d tangent;  ///< d force / d displacement [N/m], symmetric
};

/// Second Piola-Kirchhoff stress (S_xx, S_yy, S_xy) [Pa] at corner displacements q = (x0,y0,x1,y1,x2,y2) [m].
Eigen::Vector3d triangle_stress(const TriangleShape& shape, const PlaneModuli& moduli, const Vector6d& q);

/// Cauchy stress (xx, yy, xy) [Pa], per area of the deformed triangle: F S F^T / det F.
Eigen::Vector3d cauchy_stress(const TriangleShape& shape, const PlaneModuli& moduli, const Vector6d& q);

/// Internal forces only. `pressure` [Pa]: of a material that is heated and would expand.
Vector6d triangle_force(const TriangleShape& shape, const PlaneModuli& moduli, double thickness,
                        const Vector6d& q, double pressure = 0.0);

/// Internal forces and their derivative.
TriangleResponse triangle_response(const TriangleShape& shape, const PlaneModuli& moduli, double thickness,
                                   const Vector6d& q, double pressure = 0.0);

}  // namespace voussoir
