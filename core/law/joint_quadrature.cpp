#include "core/law/joint_quadrature.h"

#include <boost/math/quadrature/gauss.hpp>

#include "core/law/stretch_mass.h"

namespace voussoir {
namespace {

/// Adds what the point s has in the tangent; `state` holds elastic slips.
void add_point(const JointStiffness& joint, const JointState& state, double s, double weight,
               Eigen::Matrix4d& tangent) {
  const double gap = state[0] + s * (state[2] - state[0]);
  const double tau = joint.tangential * (state[1] + s * (state[3] - state[1]));
  if (gap >= 0.0) return;
  const StretchMass mass = mass_of_point(s, weight);
  add_mass(tangent, mass, 0, 0, joint.normal);
  const double cap = -joint.cap * gap;
  if (tau > cap)
    add_mass(tangent, mass, 1, 0, -joint.cap);
  else if (tau < -cap)
    add_mass(tangent, mass, 1, 0, joint.cap);
  else
    add_mass(tangent, mass, 1, 1, joint.tangential);
}

template <class Add>
void at_gauss_points(const Add& add) {
  using Rule = boost::math::quadrature::gauss<double, 16>;
  for (std::size_t i = 0; i < Rule::abscissa().size(); ++i)
    for (const double x : {-Rule::abscissa()[i], Rule::abscissa()[i]})
      add(0.5 * (1.0 + x), 0.5 * Rule::weights()[i]);
}

template <class Add>
void at_lobatto_points(const Add& add) {
  add(0.0, 1.0 / 6.0);
  add(0.5, 4.0 / 6.0);
  add(1.0, 1.0 / 6.0);
}

}  // namespace

JointResponse integrate_joint(const JointStiffness& joint, const JointMemory& memory, const JointState& state,
                              JointRule rule) {
  if (rule == JointRule::exact) return integrate_joint(joint, memory, state);
  const JointState elastic(state[0], state[1] - memory.slip_0, state[2], state[3] - memory.slip_1);
  Eigen::Matrix4d tangent = Eigen::Matrix4d::Zero();
  const auto add = [&](double s, double weight) { add_point(joint, elastic, s, weight, tangent); };
  if (rule == JointRule::gauss_16)
    at_gauss_points(add);
  else
    at_lobatto_points(add);
  return {tangent * elastic, tangent};
}

}  // namespace voussoir
