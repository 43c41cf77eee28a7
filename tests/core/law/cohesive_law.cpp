#include "core/law/cohesive_law.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

using namespace voussoir;

namespace {

/// Joints of Lourenco and Rots (1997), with a residual friction below the mortar's own.
JointMaterial mortared(double residual_friction = 0.6) {
  return {.normal_stiffness = 82e9,
          .tangential_stiffness = 36e9,
          .friction_angle = std::atan(residual_friction),
          .mortar = {.tensile_strength = 0.25e6,
                     .opening_energy = 18.0,
                     .cohesion = 0.35e6,
                     .slip_energy = 125.0,
                     .friction_angle = std::atan(0.75),
                     .compressive_strength = 10.5e6,
                     .crushing_energy = 5000.0}};
}

/// Goes from one (gap, slip) to another in equal steps; adds up work by the trapezoidal rule and what the law
/// calls dissipated.
struct Walk {
  CohesiveStiffness joint;
  BondMemory memory{};
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  double work = 0.0;
  double dissipated = 0.0;
  double least_dissipated = 0.0;  ///< in one step

  Eigen::Vector2d stress() const {
    const BondResponse r = bond_response(joint, memory, at[0], at[1]);
    return {r.normal, r.shear};
  }

  void to(Eigen::Vector2d place, int steps) {
    const Eigen::Vector2d step = (place - at) / steps;
    for (int i = 0; i < steps; ++i) {
      const Eigen::Vector2d before = stress();
      at += step;
      const BondResponse r = bond_response(joint, memory, at[0], at[1]);
      work += 0.5 * (before + Eigen::Vector2d(r.normal, r.shear)).dot(step);
      dissipated += r.dissipated;
      least_dissipated = std::min(least_dissipated, r.dissipated);
      memory = r.memory;
    }
  }

  double stored() const {
    const double xi = at[1] - memory.plastic_slip;
    return 0.5 * stress()[0] * (at[0] + memory.crushed) + 0.5 * joint.dry.tangential * xi * xi;
  }
};

BondMemory random_memory(std::mt19937& generator) {
  std::exponential_distribution<double> some(1.0);
  std::normal_distribution<double> slip(0.0, 1e-5);
  return {slip(generator), 5e-5 * some(generator), 2e-4 * some(generator), 1e-6 * some(generator)};
}

}  // namespace

TEST_CASE("Pulled apart, mortar carries f_t and dissipates G_I (closed form)", "[mortar]") {
  const JointMaterial material = mortared();
  Walk walk{cohesive_stiffness(material, 1.0)};
  double strongest = 0.0;
  for (int i = 0; i < 20000; ++i) {
    walk.to({walk.at[0] + 1e-7, 0.0}, 1);
    strongest = std::max(strongest, walk.stress()[0]);
  }
  CHECK(strongest == Approx(0.25e6).epsilon(0.01));
  CHECK(walk.work == Approx(18.0).epsilon(0.01));
  CHECK(walk.dissipated == Approx(18.0).epsilon(1e-6));
}

TEST_CASE("Slid under pressure, mortar carries c + mu p and dissipates G_II beside friction (closed form)",
          "[mortar]") {
  const double pressure = GENERATE(0.0, 0.3e6, 1.0e6);
  const JointMaterial material = mortared(0.75);
  Walk walk{cohesive_stiffness(material, 1.0)};
  walk.to({-pressure / 82e9, 0.0}, 1);
  constexpr double kFar = 6e-3;  // seventeen times l_2
  double strongest = 0.0;
  for (int i = 0; i < 20000; ++i) {
    walk.to({walk.at[0], walk.at[1] + kFar / 20000}, 1);
    strongest = std::max(strongest, walk.stress()[1]);
  }
  const double friction_work = 0.75 * pressure * walk.memory.slipped;
  CHECK(strongest == Approx(0.35e6 + 0.75 * pressure).epsilon(0.01));
  CHECK(walk.dissipated - friction_work == Approx(125.0).epsilon(1e-3));
  CHECK(walk.work - walk.stored() == Approx(walk.dissipated).epsilon(1e-3));
  CHECK(walk.stress()[1] == Approx(0.75 * pressure).margin(2.0));
}

TEST_CASE("Opened mortar unloads to the origin, closed mortar is as stiff as ever (the law's definition)",
          "[mortar]") {
  Walk walk{cohesive_stiffness(mortared(), 1.0)};
  walk.to({5e-5, 0.0}, 50);
  const double reached = walk.stress()[0];
  CHECK(reached < 0.2e6);
  walk.to({2.5e-5, 0.0}, 1);
  CHECK(walk.stress()[0] == Approx(0.5 * reached));
  walk.to({-1e-6, 0.0}, 1);
  CHECK(walk.stress()[0] == Approx(-82e9 * 1e-6));
  walk.to({5e-5, 0.0}, 1);
  CHECK(walk.stress()[0] == Approx(reached));
}

TEST_CASE("Crushed mortar bears f_m, stays thinner and dissipates G_c (closed form)", "[mortar]") {
  Walk walk{cohesive_stiffness(mortared(), 1.0)};
  double strongest = 0.0;
  for (int i = 0; i < 10000; ++i) {
    walk.to({walk.at[0] - 1e-6, 0.0}, 1);
    strongest = std::max(strongest, -walk.stress()[0]);
  }
  CHECK(strongest == Approx(10.5e6).epsilon(0.01));
  CHECK(walk.dissipated == Approx(5000.0).epsilon(1e-3));
  CHECK(walk.work == Approx(5000.0).epsilon(0.01));
  const double thinner = walk.memory.crushed;
  walk.to({-thinner, 0.0}, 1);
  CHECK(walk.memory.crushed == thinner);
  CHECK(walk.stress()[0] == Approx(0.0).margin(1e-3));
}

TEST_CASE("Without G_c crushed mortar bears f_m for ever (closed form)", "[mortar]") {
  JointMaterial material = mortared();
  material.mortar.crushing_energy = std::numeric_limits<double>::infinity();
  Walk walk{cohesive_stiffness(material, 1.0)};
  walk.to({-1e-3, 0.0}, 100);
  CHECK(walk.stress()[0] == Approx(-10.5e6));
  CHECK(walk.dissipated == Approx(10.5e6 * walk.memory.crushed));
  CHECK(walk.memory.crushed == Approx(1e-3 - 10.5e6 / 82e9));
}

TEST_CASE("The mortar's tangent is the derivative of its force (finite differences)", "[mortar]") {
  std::mt19937 generator(11);
  std::normal_distribution<double> normal(0.0, 1.0);
  const CohesiveStiffness joint = cohesive_stiffness(mortared(), 0.02);
  int slid = 0;
  int opened = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    JointMemory memory;
    for (std::size_t i = 0; i < kBondPoints; ++i) memory.bond.push_back(random_memory(generator));
    const JointState state(3e-5 * normal(generator), 1e-4 * normal(generator), 3e-5 * normal(generator),
                           1e-4 * normal(generator));
    const double h = 1e-11;
    Eigen::Matrix4d difference;
    for (int k = 0; k < 4; ++k) {
      const JointState dx = h * JointState::Unit(k);
      difference.col(k) = (integrate_bond(joint, memory, state + dx).force -
                           integrate_bond(joint, memory, state - dx).force) /
                          (2 * h);
    }
    const JointMemory after = updated_bond(joint, memory, state);
    for (std::size_t i = 0; i < kBondPoints; ++i) {
      slid += after.bond[i].slipped > memory.bond[i].slipped;
      opened += after.bond[i].opening > memory.bond[i].opening;
    }
    const Eigen::Matrix4d tangent = integrate_bond(joint, memory, state).tangent;
    CHECK((difference - tangent).norm() < 1e-5 * joint.dry.normal);
  }
  CHECK(slid > 1000);
  CHECK(opened > 1000);
}

TEST_CASE("Energy is never made: 10,000 random paths (first law, work by the trapezoidal rule)", "[mortar]") {
  std::mt19937 generator(12);
  std::normal_distribution<double> normal(0.0, 1.0);
  const CohesiveStiffness joint = cohesive_stiffness(mortared(), 1.0);
  double made = 0.0;        // most that a step has made
  double unbalanced = 0.0;  // work that is neither stored nor dissipated, over the work
  for (int path = 0; path < 10000; ++path) {
    Walk walk{joint};
    double scale = 0.0;
    for (int leg = 0; leg < 6; ++leg) {
      const Eigen::Vector2d place(6e-5 * normal(generator), 2e-4 * normal(generator));
      const int steps = path < 200 ? 2000 : 1 + static_cast<int>(generator() % 20);
      walk.to(place, steps);
      scale = std::max(scale, std::abs(walk.work));
    }
    made = std::min(made, walk.least_dissipated);
    if (path < 200)
      unbalanced = std::max(unbalanced, std::abs(walk.work - walk.stored() - walk.dissipated) / scale);
  }
  CHECK(made >= 0.0);
  CHECK(unbalanced < 0.01);
}

TEST_CASE("Worn mortar is a dry joint of the residual friction (independent: the dry law)", "[mortar]") {
  const JointMaterial material = mortared();
  const CohesiveStiffness joint = cohesive_stiffness(material, 0.5);
  const JointStiffness dry = joint_stiffness(material, 0.5);
  JointMemory worn;
  worn.bond.assign(kBondPoints, {.plastic_slip = 0.0, .opening = 1.0, .slipped = 1.0, .crushed = 0.0});
  for (const JointState& state : {JointState(-1e-5, 1e-6, -3e-5, 2e-6), JointState(-1e-5, 4e-4, -3e-5, 5e-4),
                                  JointState(1e-5, 4e-4, 3e-5, 5e-4)}) {
    const JointResponse with = integrate_bond(joint, worn, state);
    const JointResponse without = integrate_joint(dry, {}, state);
    CHECK((with.force - without.force).norm() <= 1e-9 * dry.normal * 1e-5);
  }
  const JointMemory after = updated_bond(joint, worn, {1e-5, 4e-4, 3e-5, 4e-4});
  for (const BondMemory& point : after.bond) CHECK(point.plastic_slip == Approx(4e-4));
}
