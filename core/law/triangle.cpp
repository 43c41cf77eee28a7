#include "core/law/triangle.h"

#include <Eigen/LU>

#include "core/geometry/polygon.h"

namespace voussoir {
namespace {

/// Displacement gradient H.
Eigen::Matrix2d displacement_gradient(const TriangleShape& shape, const Vector6d& q) {
  return Eigen::Map<const Eigen::Matrix<double, 2, 3>>(q.data()) * shape.gradient.transpose();
}

/// From H, not from F, so that small strains keep their digits.
Eigen::Vector3d stress_of(const Eigen::Matrix2d& h, const PlaneModuli& moduli, double pressure) {
  const double xx = h(0, 0) + 0.5 * (h(0, 0) * h(0, 0) + h(1, 0) * h(1, 0));
  const double yy = h(1, 1) + 0.5 * (h(0, 1) * h(0, 1) + h(1, 1) * h(1, 1));
  const double twice_xy = h(0, 1) + h(1, 0) + h(0, 0) * h(0, 1) + h(1, 0) * h(1, 1);
  return {moduli.a * xx + moduli.b * yy - pressure, moduli.b * xx + moduli.a * yy - pressure,
          moduli.g * twice_xy};
}

Eigen::Matrix2d tensor(const Eigen::Vector3d& s) {
  Eigen::Matrix2d matrix;
  matrix << s[0], s[2], s[2], s[1];
  return matrix;
}

}  // namespace

PlaneModuli plane_moduli(const Material& material) {
  const double e = material.young_modulus;
  const double nu = material.poisson_ratio;
  const double g = e / (2.0 * (1.0 + nu));
  if (material.plane == PlaneState::stress) return {e / (1.0 - nu * nu), e * nu / (1.0 - nu * nu), g};
  const double factor = e / ((1.0 + nu) * (1.0 - 2.0 * nu));
  return {factor * (1.0 - nu), factor * nu, g};
}

double thermal_pressure(const Material& material) {
  const PlaneModuli moduli = plane_moduli(material);
  // In plane strain the material cannot expand out of the plane either.
  const double out_of_plane = material.plane == PlaneState::strain ? 1.0 + material.poisson_ratio : 1.0;
  return (moduli.a + moduli.b) * out_of_plane * material.thermal_expansion;
}

TriangleShape triangle_shape(const Point& a, const Point& b, const Point& c) {
  const double twice_area = cross(b - a, c - a);
  TriangleShape shape;
  shape.area = 0.5 * twice_area;
  shape.gradient << b.y() - c.y(), c.y() - a.y(), a.y() - b.y(), c.x() - b.x(), a.x() - c.x(), b.x() - a.x();
  shape.gradient /= twice_area;
  return shape;
}

Eigen::Vector3d triangle_stress(const TriangleShape& shape, const PlaneModuli& moduli, const Vector6d& q) {
  return stress_of(displacement_gradient(shape, q), moduli, 0.0);
}

Eigen::Vector3d cauchy_stress(const TriangleShape& shape, const PlaneModuli& moduli, const Vector6d& q) {
  const Eigen::Matrix2d h = displacement_gradient(shape, q);
  const Eigen::Matrix2d f = Eigen::Matrix2d::Identity() + h;
  const Eigen::Matrix2d cauchy = f * tensor(stress_of(h, moduli, 0.0)) * f.transpose() / f.determinant();
  return {cauchy(0, 0), cauchy(1, 1), cauchy(0, 1)};
}

Vector6d triangle_force(const TriangleShape& shape, const PlaneModuli& moduli, double thickness,
                        const Vector6d& q, double pressure) {
  const Eigen::Matrix2d h = displacement_gradient(shape, q);
  const Eigen::Matrix2d first_piola =
      (Eigen::Matrix2d::Identity() + h) * tensor(stress_of(h, moduli, pressure));
  Vector6d force;
  Eigen::Map<Eigen::Matrix<double, 2, 3>>(force.data()) =
      (shape.area * thickness) * first_piola * shape.gradient;
  return force;
}

TriangleResponse triangle_response(const TriangleShape& shape, const PlaneModuli& moduli, double thickness,
                                   const Vector6d& q, double pressure) {
  const Eigen::Matrix2d h = displacement_gradient(shape, q);
  const Eigen::Matrix2d f = Eigen::Matrix2d::Identity() + h;
  const Eigen::Vector3d s = stress_of(h, moduli, pressure);
  const Eigen::Matrix2d stress = tensor(s);

  // B: d(E_xx, E_yy, 2 E_xy) / d q
  Eigen::Matrix<double, 3, 6> strain_gradient;
  for (int i = 0; i < 3; ++i) {
    const double x = shape.gradient(0, i);
    const double y = shape.gradient(1, i);
    for (int c = 0; c < 2; ++c)
      strain_gradient.col(2 * i + c) << f(c, 0) * x, f(c, 1) * y, f(c, 0) * y + f(c, 1) * x;
  }
  Eigen::Matrix3d elasticity;
  elasticity << moduli.a, moduli.b, 0.0, moduli.b, moduli.a, 0.0, 0.0, 0.0, moduli.g;

  const double volume = shape.area * thickness;
  TriangleResponse response;
  const Eigen::Matrix<double, 3, 6> stress_gradient = (volume * elasticity).lazyProduct(strain_gradient);
  response.force = volume * strain_gradient.transpose().lazyProduct(s);
  response.tangent = strain_gradient.transpose().lazyProduct(stress_gradient);
  const Eigen::Matrix3d initial = volume * shape.gradient.transpose() * stress * shape.gradient;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int c = 0; c < 2; ++c) response.tangent(2 * i + c, 2 * j + c) += initial(i, j);
  return response;
}

}  // namespace voussoir
