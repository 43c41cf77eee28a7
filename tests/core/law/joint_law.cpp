#include "core/law/joint_quadrature.h"

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
    const Eigen::Vector4d exact = integrate_joint(joint_stiffness(material, 0.7), {}, state).force;
    const Eigen::Vector4d summed = by_quadrature(material, 0.7, state, 20000);
    CHECK((exact - summed).norm() < 1e-6 * (1e3 + summed.norm()));
  }
}

TEST_CASE(
    "Every rule is exact where a joint sticks, and sixteen points come near it elsewhere (exact integration)",
    "[joint]") {
  const JointMaterial material;
  const JointState sticking = {-1e-4, 2e-5, -3e-4, -1e-5};
  const Eigen::Vector4d force = integrate_joint(joint_stiffness(material, 0.7), {}, sticking).force;
  for (const JointRule rule : {JointRule::exact, JointRule::lobatto_3, JointRule::gauss_16})
    CHECK((integrate_joint(joint_stiffness(material, 0.7), {}, sticking, rule).force - force).norm() <
          1e-12 * force.norm());
  std::mt19937 generator(3);
  double coarse = 0.0;
  double fine = 0.0;
  for (int trial = 0; trial < 200; ++trial) {
    const JointState state = random_state(generator);
    const Eigen::Vector4d exact = integrate_joint(joint_stiffness(material, 0.7), {}, state).force;
    coarse += (integrate_joint(joint_stiffness(material, 0.7), {}, state, JointRule::lobatto_3).force - exact)
                  .norm();
    fine += (integrate_joint(joint_stiffness(material, 0.7), {}, state, JointRule::gauss_16).force - exact)
                .norm();
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
      difference.col(k) = (integrate_joint(joint_stiffness(material, 0.7), {}, state + dx).force -
                           integrate_joint(joint_stiffness(material, 0.7), {}, state - dx).force) /
                          (2 * h);
    }
    // Differences over 1e-9 of gaps of 1e-4 are off by 1e-5 of the part of the joint where the state changes.
    CHECK((difference - integrate_joint(joint_stiffness(material, 0.7), {}, state).tangent).norm() <
          1e-6 * 0.7e9);
    ++checked;
  }
  CHECK(checked == 200);
}

TEST_CASE("An open joint carries nothing, a closed one p_n times penetration", "[joint]") {
  const JointMaterial material;
  CHECK(integrate_joint(joint_stiffness(material, 1.0), {}, {1e-3, 1e-3, 2e-3, 0.0}).force.norm() == 0.0);
  const Eigen::Vector4d closed =
      integrate_joint(joint_stiffness(material, 2.0), {}, {-1e-4, 0.0, -1e-4, 0.0}).force;
  CHECK(closed[0] + closed[2] == Approx(-2.0 * 1e9 * 1e-4));
}

TEST_CASE("Shear never exceeds friction times pressure and opposes the slip", "[joint]") {
  const JointMaterial material;
  const Eigen::Vector4d force =
      integrate_joint(joint_stiffness(material, 1.0), {}, {-1e-4, 1.0, -2e-4, 1.0}).force;
  CHECK(force[1] + force[3] == Approx(-std::tan(material.friction_angle) * (force[0] + force[2])));
  const Eigen::Vector4d back =
      integrate_joint(joint_stiffness(material, 1.0), {}, {-1e-4, -1.0, -2e-4, -1.0}).force;
  CHECK(back[1] + back[3] == Approx(-(force[1] + force[3])));
}

TEST_CASE("A linearly closed joint has the triangle's resultant at a third of its length", "[joint]") {
  // gap from -d at s = 0 to +d at s = 1: pressure triangle over half the length.
  const double d = 1e-4;
  const Eigen::Vector4d force =
      integrate_joint(joint_stiffness(JointMaterial{}, 1.0), {}, {-d, 0.0, d, 0.0}).force;
  const double total = -(force[0] + force[2]);
  CHECK(total == Approx(0.5 * 0.5 * 1e9 * d));
  CHECK(-force[2] / total == Approx(0.5 / 3.0));  // lever arm from s = 0
}

TEST_CASE("What a joint has slipped it remembers, and the shear stays the same (the definition of memory)",
          "[joint]") {
  const JointMaterial material;
  const JointStiffness joint = joint_stiffness(material, 0.7);
  std::mt19937 generator(5);
  int slipped = 0;
  for (int trial = 0; trial < 200; ++trial) {
    JointState state = random_state(generator);
    state[0] = -std::abs(state[0]);
    state[2] = -std::abs(state[2]);
    if (trial % 2 == 0) state[1] = state[3] = (trial % 4 == 0 ? 1e-2 : -1e-2);  // slips as a whole
    const JointMemory memory = updated_memory(joint, {}, state);
    const Eigen::Vector4d before = integrate_joint(joint, {}, state).force;
    const Eigen::Vector4d after = integrate_joint(joint, memory, state).force;
    CHECK((after - before).norm() < 1e-12 * before.norm());
    CHECK(memory.slip_0 == memory.slip_1);
    if (memory.slip_0 != 0.0) ++slipped;
  }
  CHECK(slipped >= 100);
}

TEST_CASE("A joint that slides to and fro does the work of friction (closed form of a rigid-plastic loop)",
          "[joint]") {
  const JointMaterial material;
  const JointStiffness joint = joint_stiffness(material, 2.0);
  constexpr double kGap = -1e-4;
  const double cap = joint.cap * -kGap;  // shear force at the bound
  const double elastic = cap / joint.tangential;
  JointMemory memory;
  const auto shear_at = [&](double slip) {
    const JointState state(kGap, slip, kGap, slip);
    const Eigen::Vector4d force = integrate_joint(joint, memory, state).force;
    memory = updated_memory(joint, memory, state);
    return force[1] + force[3];
  };
  CHECK(shear_at(0.5 * elastic) == Approx(0.5 * cap));
  CHECK(memory == JointMemory{});
  CHECK(shear_at(5.0 * elastic) == Approx(cap));
  CHECK(memory.slip_0 == Approx(4.0 * elastic));
  CHECK(shear_at(4.5 * elastic) == Approx(0.5 * cap));  // unloads with the elastic stiffness
  CHECK(shear_at(3.0 * elastic) == Approx(-cap));
  CHECK(shear_at(0.0) == Approx(-cap));
  CHECK(memory.slip_0 == Approx(elastic));
}

TEST_CASE("A joint that opens forgets what it has slipped", "[joint]") {
  const JointStiffness joint = joint_stiffness(JointMaterial{}, 1.0);
  const JointMemory memory = updated_memory(joint, {1e-3, 2e-3}, {1e-5, 3e-3, 2e-5, 4e-3});
  CHECK(memory == JointMemory{3e-3, 4e-3});
  CHECK(integrate_joint(joint, memory, {-1e-5, 3e-3, -1e-5, 4e-3}).force[1] == 0.0);
}
