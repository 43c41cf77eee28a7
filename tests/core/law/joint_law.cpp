#include "core/law/joint_law.h"

#include <catch2/catch.hpp>
#include <random>

using namespace voussoir;

namespace {

/// Oracle: the law point by point, summed over many midpoints.
Eigen::Vector4d by_quadrature(const JointMaterial& m, double area, const JointState& state, int points) {
  Eigen::Vector4d force = Eigen::Vector4d::Zero();
  for (int i = 0; i < points; ++i) {
    const double s = (i + 0.5) / points;
    const double gap = (1 - s) * state[0] + s * state[2];
    const double slip = (1 - s) * state[1] + s * state[3];
    const double sigma = m.normal_stiffness * std::max(0.0, -gap);
    const double cap = std::tan(m.friction_angle) * sigma;
    const double tau = std::clamp(m.tangential_stiffness * slip, -cap, cap);
    force += area / points * Eigen::Vector4d(-(1 - s) * sigma, (1 - s) * tau, -s * sigma, s * tau);
  }
  return force;
}

JointState random_state(std::mt19937& generator) {
  std::normal_distribution<double> normal(0.0, 1e-4);
  return {normal(generator), 7.0 * normal(generator), normal(generator), 7.0 * normal(generator)};
}

}  // namespace

TEST_CASE("Joint forces equal a fine quadrature of the point law", "[joint]") {
  std::mt19937 generator(1);
  const JointMaterial material;
  for (int trial = 0; trial < 200; ++trial) {
    const JointState state = random_state(generator);
    const Eigen::Vector4d exact = integrate_joint(material, 0.7, state).force;
    const Eigen::Vector4d summed = by_quadrature(material, 0.7, state, 20000);
    CHECK((exact - summed).norm() < 1e-6 * (1e3 + summed.norm()));
  }
}

TEST_CASE(
    "Every rule is exact where a joint sticks, and sixteen points come near it elsewhere (exact integration)",
    "[joint]") {
  const JointMaterial material;
  const JointState sticking = {-1e-4, 2e-5, -3e-4, -1e-5};
  const Eigen::Vector4d force = integrate_joint(material, 0.7, sticking).force;
  for (const JointRule rule : {JointRule::exact, JointRule::lobatto_3, JointRule::gauss_16})
    CHECK((integrate_joint(material, 0.7, sticking, rule).force - force).norm() < 1e-12 * force.norm());
  std::mt19937 generator(3);
  double coarse = 0.0;
  double fine = 0.0;
  for (int trial = 0; trial < 200; ++trial) {
    const JointState state = random_state(generator);
    const Eigen::Vector4d exact = integrate_joint(material, 0.7, state).force;
    coarse += (integrate_joint(material, 0.7, state, JointRule::lobatto_3).force - exact).norm();
    fine += (integrate_joint(material, 0.7, state, JointRule::gauss_16).force - exact).norm();
  }
  CHECK(fine < 0.1 * coarse);
  CHECK(coarse > 0.0);
}

TEST_CASE("The joint tangent is the derivative of the joint force", "[joint]") {
  std::mt19937 generator(2);
  const JointMaterial material;
  int checked = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const JointState state = random_state(generator);
    const double h = 1e-9;
    Eigen::Matrix4d difference;
    for (int k = 0; k < 4; ++k) {
      const JointState dx = h * JointState::Unit(k);
      difference.col(k) = (integrate_joint(material, 0.7, state + dx).force -
                           integrate_joint(material, 0.7, state - dx).force) /
                          (2 * h);
    }
    // Differences over 1e-9 of gaps of 1e-4 are off by 1e-5 of the part of the joint where the state changes.
    CHECK((difference - integrate_joint(material, 0.7, state).tangent).norm() < 1e-6 * 0.7e9);
    ++checked;
  }
  CHECK(checked == 200);
}

TEST_CASE("An open joint carries nothing, a closed one p_n times penetration", "[joint]") {
  const JointMaterial material;
  CHECK(integrate_joint(material, 1.0, {1e-3, 1e-3, 2e-3, 0.0}).force.norm() == 0.0);
  const Eigen::Vector4d closed = integrate_joint(material, 2.0, {-1e-4, 0.0, -1e-4, 0.0}).force;
  CHECK(closed[0] + closed[2] == Approx(-2.0 * 1e9 * 1e-4));
}

TEST_CASE("Shear never exceeds friction times pressure and opposes the slip", "[joint]") {
  const JointMaterial material;
  const Eigen::Vector4d force = integrate_joint(material, 1.0, {-1e-4, 1.0, -2e-4, 1.0}).force;
  CHECK(force[1] + force[3] == Approx(-std::tan(material.friction_angle) * (force[0] + force[2])));
  const Eigen::Vector4d back = integrate_joint(material, 1.0, {-1e-4, -1.0, -2e-4, -1.0}).force;
  CHECK(back[1] + back[3] == Approx(-(force[1] + force[3])));
}

TEST_CASE("A linearly closed joint has the triangle's resultant at a third of its length", "[joint]") {
  // gap from -d at s = 0 to +d at s = 1: pressure triangle over half the length.
  const double d = 1e-4;
  const Eigen::Vector4d force = integrate_joint({}, 1.0, {-d, 0.0, d, 0.0}).force;
  const double total = -(force[0] + force[2]);
  CHECK(total == Approx(0.5 * 0.5 * 1e9 * d));
  CHECK(-force[2] / total == Approx(0.5 / 3.0));  // lever arm from s = 0
}
