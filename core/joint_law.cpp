#include "core/joint_law.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace voussoir {
namespace {

/// A linear function on [0,1] by its end values.
struct Linear {
  double at_0;
  double at_1;
  double operator()(double s) const { return at_0 + s * (at_1 - at_0); }
  /// Where it changes sign strictly inside (0,1); otherwise 0.
  double root() const { return (at_0 < 0.0) != (at_1 < 0.0) ? at_0 / (at_0 - at_1) : 0.0; }
};

/// Integrals of N_k N_l over [a,b] with N_0 = 1 - s, N_1 = s.
struct MassOfPart {
  double m00, m01, m11;
  MassOfPart(double a, double b) {
    const double squares = b * b - a * a;
    const double cubes = b * b * b - a * a * a;
    m00 = (b - a) - squares + cubes / 3.0;
    m01 = squares / 2.0 - cubes / 3.0;
    m11 = cubes / 3.0;
  }
};

/// Adds coefficient * N_k N_l to the tangent block (force component `row`, state component `column`; 0 gap, 1
/// slip).
void add_part(Eigen::Matrix4d& tangent, const MassOfPart& mass, int row, int column, double coefficient) {
  tangent(row, column) += coefficient * mass.m00;
  tangent(row, column + 2) += coefficient * mass.m01;
  tangent(row + 2, column) += coefficient * mass.m01;
  tangent(row + 2, column + 2) += coefficient * mass.m11;
}

}  // namespace

JointResponse integrate_joint(const JointMaterial& material, double area, const JointState& state) {
  const double normal = area * material.normal_stiffness;
  const double tangential = area * material.tangential_stiffness;
  const double cap = area * material.friction_coefficient() * material.normal_stiffness;
  const Linear gap{state[0], state[2]};
  // Shear beyond the cap in the positive (negative) direction where this is positive (negative).
  const Linear beyond_positive{tangential * state[1] + cap * state[0],
                               tangential * state[3] + cap * state[2]};
  const Linear beyond_negative{tangential * state[1] - cap * state[0],
                               tangential * state[3] - cap * state[2]};

  std::array<double, 5> ends = {0.0, gap.root(), beyond_positive.root(), beyond_negative.root(), 1.0};
  std::sort(ends.begin(), ends.end());

  JointResponse response;
  response.tangent.setZero();
  for (std::size_t part = 0; part + 1 < ends.size(); ++part) {
    const double a = ends[part];
    const double b = ends[part + 1];
    const double middle = 0.5 * (a + b);
    if (a >= b || gap(middle) >= 0.0) continue;
    const MassOfPart mass(a, b);
    add_part(response.tangent, mass, 0, 0, normal);
    if (beyond_positive(middle) > 0.0)
      add_part(response.tangent, mass, 1, 0, -cap);
    else if (beyond_negative(middle) < 0.0)
      add_part(response.tangent, mass, 1, 0, cap);
    else
      add_part(response.tangent, mass, 1, 1, tangential);
  }
  response.force = response.tangent * state;  // the law is homogeneous of degree one
  return response;
}

Eigen::Matrix4d bonded_joint_tangent(const JointMaterial& material, double area) {
  const MassOfPart whole(0.0, 1.0);
  Eigen::Matrix4d tangent = Eigen::Matrix4d::Zero();
  add_part(tangent, whole, 0, 0, area * material.normal_stiffness);
  add_part(tangent, whole, 1, 1, area * material.tangential_stiffness);
  return tangent;
}

}  // namespace voussoir
