#include "core/law/joint_law.h"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
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

/// Integrals of N_k N_l, with N_0 = 1 - s, N_1 = s.
struct Mass {
  double m00, m01, m11;
};

Mass mass_of_part(double a, double b) {
  const double squares = b * b - a * a;
  const double cubes = b * b * b - a * a * a;
  return {(b - a) - squares + cubes / 3.0, squares / 2.0 - cubes / 3.0, cubes / 3.0};
}

Mass mass_of_point(double s, double weight) {
  return {weight * (1.0 - s) * (1.0 - s), weight * s * (1.0 - s), weight * s * s};
}

/// Adds coefficient * N_k N_l to the tangent block (force component `row`, state component `column`; 0 gap, 1
/// slip).
void add_part(Eigen::Matrix4d& tangent, const Mass& mass, int row, int column, double coefficient) {
  tangent(row, column) += coefficient * mass.m00;
  tangent(row, column + 2) += coefficient * mass.m01;
  tangent(row + 2, column) += coefficient * mass.m01;
  tangent(row + 2, column + 2) += coefficient * mass.m11;
}

/// The law along one stretch in one state.
struct StretchLaw {
  StretchLaw(const JointMaterial& material, double area, const JointState& state)
      : normal(area * material.normal_stiffness),
        tangential(area * material.tangential_stiffness),
        cap(area * material.friction_coefficient() * material.normal_stiffness),
        gap{state[0], state[2]},
        beyond_positive{tangential * state[1] + cap * state[0], tangential * state[3] + cap * state[2]},
        beyond_negative{tangential * state[1] - cap * state[0], tangential * state[3] - cap * state[2]} {}

  /// Adds what a part that is as a whole as it is at s, or the point s itself, has in the tangent.
  void add(double s, const Mass& mass, Eigen::Matrix4d& tangent) const {
    if (gap(s) >= 0.0) return;
    add_part(tangent, mass, 0, 0, normal);
    if (beyond_positive(s) > 0.0)
      add_part(tangent, mass, 1, 0, -cap);
    else if (beyond_negative(s) < 0.0)
      add_part(tangent, mass, 1, 0, cap);
    else
      add_part(tangent, mass, 1, 1, tangential);
  }

  double normal;
  double tangential;
  double cap;
  Linear gap;
  Linear beyond_positive;  ///< shear beyond the cap in the positive direction where this is positive
  Linear beyond_negative;  ///< in the negative direction where this is negative
};

/// The law is homogeneous of degree one.
JointResponse response_of(const Eigen::Matrix4d& tangent, const JointState& state) {
  return {tangent * state, tangent};
}

void add_gauss_points(const StretchLaw& law, Eigen::Matrix4d& tangent) {
  using Rule = boost::math::quadrature::gauss<double, 16>;
  for (std::size_t i = 0; i < Rule::abscissa().size(); ++i)
    for (const double x : {-Rule::abscissa()[i], Rule::abscissa()[i]}) {
      const double s = 0.5 * (1.0 + x);
      law.add(s, mass_of_point(s, 0.5 * Rule::weights()[i]), tangent);
    }
}

void add_lobatto_points(const StretchLaw& law, Eigen::Matrix4d& tangent) {
  law.add(0.0, mass_of_point(0.0, 1.0 / 6.0), tangent);
  law.add(0.5, mass_of_point(0.5, 4.0 / 6.0), tangent);
  law.add(1.0, mass_of_point(1.0, 1.0 / 6.0), tangent);
}

}  // namespace

JointResponse integrate_joint(const JointMaterial& material, double area, const JointState& state) {
  const StretchLaw law(material, area, state);
  std::array<double, 5> ends = {0.0, law.gap.root(), law.beyond_positive.root(), law.beyond_negative.root(),
                                1.0};
  std::sort(ends.begin(), ends.end());
  Eigen::Matrix4d tangent = Eigen::Matrix4d::Zero();
  for (std::size_t part = 0; part + 1 < ends.size(); ++part)
    if (ends[part] < ends[part + 1])
      law.add(0.5 * (ends[part] + ends[part + 1]), mass_of_part(ends[part], ends[part + 1]), tangent);
  return response_of(tangent, state);
}

JointResponse integrate_joint(const JointMaterial& material, double area, const JointState& state,
                              JointRule rule) {
  if (rule == JointRule::exact) return integrate_joint(material, area, state);
  const StretchLaw law(material, area, state);
  Eigen::Matrix4d tangent = Eigen::Matrix4d::Zero();
  if (rule == JointRule::gauss_16)
    add_gauss_points(law, tangent);
  else
    add_lobatto_points(law, tangent);
  return response_of(tangent, state);
}

std::string_view to_string(JointRule rule) {
  switch (rule) {
    case JointRule::lobatto_3:
      return "lobatto-3";
    case JointRule::gauss_16:
      return "gauss-16";
    case JointRule::exact:
      break;
  }
  return "exact";
}

Eigen::Matrix4d bonded_joint_tangent(const JointMaterial& material, double area) {
  const Mass whole = mass_of_part(0.0, 1.0);
  Eigen::Matrix4d tangent = Eigen::Matrix4d::Zero();
  add_part(tangent, whole, 0, 0, area * material.normal_stiffness);
  add_part(tangent, whole, 1, 1, area * material.tangential_stiffness);
  return tangent;
}

}  // namespace voussoir
