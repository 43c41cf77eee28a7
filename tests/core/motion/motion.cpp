#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/motion/critical_step.h"
#include "core/motion/motion_step.h"
#include "core/structure/model.h"
#include "tools/validation/assemblies.h"

namespace voussoir {
namespace {

using One = double;
using validation::block_on_wedge;
using validation::floating_course;

void run(const MotionModel& model, int steps, Motion<One>& motion) {
  for (int i = 0; i < steps; ++i) {
    if (motion.travel > 0.005) search_contacts(model, 0.01, 0, motion);
    take_implicit_step(model, motion);
  }
}

struct Momentum {
  Point linear = Point::Zero();
  double angular = 0.0;  ///< about the origin
};

Momentum momentum(const MotionModel& model, const Motion<One>& motion) {
  Momentum sum;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BlockFrame<One>& frame = motion.frames[b];
    const Point v(frame.velocity.x, frame.velocity.y);
    sum.linear += model.bodies[b].mass * v;
    sum.angular += model.bodies[b].mass * cross(Point(frame.centre.x, frame.centre.y), v) +
                   model.bodies[b].inertia * frame.spin;
  }
  return sum;
}

Momentum nodal_momentum(const MotionModel& model, const Motion<One>& motion) {
  Momentum sum;
  for (std::size_t i = 0; i < motion.places.size(); ++i) {
    const double m = model.masses[static_cast<Eigen::Index>(i)];
    const Point v(motion.rates[i].x, motion.rates[i].y);
    sum.linear += m * v;
    sum.angular += m * cross(Point(motion.places[i].x, motion.places[i].y), v);
  }
  return sum;
}

/// Two blocks that are thrown at each other askew.
Motion<One> collision(const MotionModel& model) {
  Motion<One> motion = at_rest<One>(model);
  motion.frames[0].velocity = {1.5, 0.3};
  motion.frames[0].spin = 2.0;
  motion.frames[1].velocity = {-0.5, -0.2};
  motion.frames[1].spin = -1.0;
  return motion;
}

constexpr double kThirtyFive = 35.0 * std::numbers::pi / 180.0;

}  // namespace

TEST_CASE("A block in free flight keeps its momentum and energy to round-off (conservation laws)") {
  const Model bridge = floating_course(1, kThirtyFive);
  const MotionModel model(bridge, make_block_bodies(bridge, RotationalInertia::exact), Pace{3e-4}, 0.0, 0.0);
  Motion<One> motion = at_rest<One>(model);
  motion.frames[0].velocity = {3.0, -1.0};
  motion.frames[0].spin = 5.0;
  const Momentum before = momentum(model, motion);
  const double energy = kinetic_energy(model, motion, 0);
  run(model, 5000, motion);
  const Momentum after = momentum(model, motion);
  CHECK((after.linear - before.linear).norm() <= 1e-12 * before.linear.norm());
  CHECK(after.angular == Approx(before.angular).epsilon(1e-11));
  CHECK(kinetic_energy(model, motion, 0) == Approx(energy).epsilon(1e-12));
  // 1.5 s at 5 rad/s
  CHECK(std::atan2(motion.frames[0].rotation.y, motion.frames[0].rotation.x) ==
        Approx(std::remainder(7.5, 2.0 * std::numbers::pi)).margin(1e-6));
}

TEST_CASE(
    "A free block under central differences keeps linear and angular momentum to round-off (conservation "
    "laws)") {
  const Model bridge = floating_course(1, kThirtyFive);
  const std::vector<BlockBody> bodies = make_block_bodies(bridge, RotationalInertia::exact);
  const double step = 0.5 * critical_step(bridge, bodies, Integrator::central_differences, 0.0);
  const MotionModel model(bridge, make_block_bodies(bridge, RotationalInertia::exact), Pace{step}, 0.0, 0.0);
  Motion<One> motion = at_rest<One>(model);
  for (std::size_t i = 0; i < motion.rates.size(); ++i)
    motion.rates[i] = {3.0 - 5.0 * (motion.places[i].y - 0.25), -1.0 + 5.0 * (motion.places[i].x - 0.5)};
  const Momentum before = nodal_momentum(model, motion);
  const double energy = kinetic_energy(model, motion, 0);
  for (int i = 0; i < 20000; ++i) take_explicit_step(model, motion);
  const Momentum after = nodal_momentum(model, motion);
  CHECK((after.linear - before.linear).norm() <= 1e-10 * before.linear.norm());
  CHECK(after.angular == Approx(before.angular).epsilon(1e-10));
  CHECK(kinetic_energy(model, motion, 0) == Approx(energy).epsilon(1e-5));  // it also vibrates a little
}

TEST_CASE(
    "Blocks that collide without friction keep linear and angular momentum, and gain no energy (conservation "
    "laws)") {
  const Model bridge = floating_course(2, 0.0);
  const MotionModel model(bridge, make_block_bodies(bridge, RotationalInertia::exact), Pace{2e-5}, 0.0, 0.0);
  Motion<One> motion = collision(model);
  const Momentum before = momentum(model, motion);
  const double energy = kinetic_energy(model, motion, 0);
  run(model, 20000, motion);
  const Momentum after = momentum(model, motion);
  CHECK((after.linear - before.linear).norm() <= 1e-12 * before.linear.norm());
  CHECK(after.angular == Approx(before.angular).epsilon(1e-4));      // moments act at places a step apart
  CHECK(motion.frames[1].velocity.x > motion.frames[0].velocity.x);  // they have parted
  CHECK(kinetic_energy(model, motion, 0) <= energy * (1.0 + 1e-3));
  CHECK(kinetic_energy(model, motion, 0) >= 0.9 * energy);  // only the implicit vibrations are damped
}

TEST_CASE("Friction and damping never add energy to colliding blocks (second law)") {
  const Model bridge = floating_course(3, kThirtyFive);
  for (const double damping : {0.0, 5.0}) {
    const MotionModel model(bridge, make_block_bodies(bridge, RotationalInertia::exact), Pace{1e-4}, damping,
                            1e-4);
    Motion<One> motion = collision(model);
    motion.frames[2].velocity = {-2.0, 0.4};
    double energy = kinetic_energy(model, motion, 0);
    for (int look = 0; look < 20; ++look) {
      run(model, 500, motion);
      const double now = kinetic_energy(model, motion, 0);
      // contacts hold some energy for a while: compare with all that has been lost before
      INFO("look " << look << " damping " << damping);
      CHECK(now <= energy * 1.001);
      if (look % 5 == 4) energy = now;
    }
  }
}

TEST_CASE("A block's moment of inertia is that of its area, whatever its triangles (closed form)") {
  const Model coarse = floating_course(1, kThirtyFive);
  Model fine = coarse;
  static_cast<Structure&>(fine) = assemble(coarse.layout.blocks, {.mesh = {.refinement = 2}});
  const double expected = 0.5 * 2400.0 * (1.0 + 0.25) / 12.0;  // m (b^2 + h^2) / 12
  CHECK(make_block_bodies(coarse, RotationalInertia::exact)[0].inertia == Approx(expected).epsilon(1e-12));
  CHECK(make_block_bodies(fine, RotationalInertia::exact)[0].inertia == Approx(expected).epsilon(1e-12));
}

TEST_CASE("What is laid on a block turns with it (closed form)") {
  Model bridge = floating_course(1, kThirtyFive);  // 1 m x 0.5 m, 1200 kg
  bridge.parameters.laid_mass = Eigen::VectorXd::Zero(bridge.mesh.node_count());
  const double top = bridge.mesh.nodes.row(1).maxCoeff(), laid = 300.0;
  for (int node = 0; node < bridge.mesh.node_count(); ++node)
    if (bridge.mesh.nodes(1, node) == top) bridge.parameters.laid_mass[node] = laid;  // at both corners
  const double lifted = 600.0 * 0.25 / 1800.0;  // the centre, over the block's own
  const double expected =
      1200.0 * (1.25 / 12.0 + lifted * lifted) + 2.0 * laid * (0.25 + (0.25 - lifted) * (0.25 - lifted));
  CHECK(make_block_bodies(bridge, RotationalInertia::exact)[0].inertia == Approx(expected).epsilon(1e-12));
}

TEST_CASE("The shear of contacts survives a new search (the same run without searches)") {
  const Model bridge = block_on_wedge(30.0 * std::numbers::pi / 180.0, kThirtyFive);
  const MotionModel model(bridge, make_block_bodies(bridge, RotationalInertia::exact), Pace{2e-4}, 20.0,
                          1e-4);
  Motion<One> once = at_rest<One>(model);
  Motion<One> often = at_rest<One>(model);
  for (int i = 1; i <= 500; ++i) {
    once.load = often.load = std::min(1.0, i / 200.0);
    run(model, 1, once);
    search_contacts(model, 0.02, 0, often);
    take_implicit_step(model, often);
  }
  REQUIRE(once.contacts.size() > 0);
  for (std::size_t i = 0; i < once.places.size(); ++i) {
    CHECK(often.places[i].x == once.places[i].x);
    CHECK(often.places[i].y == once.places[i].y);
  }
}

TEST_CASE("A search in one lane leaves the contacts of the others alone (what each lane finds by itself)") {
  const Model bridge = floating_course(2, kThirtyFive);
  const MotionModel model(bridge, make_block_bodies(bridge, RotationalInertia::exact), Pace{3e-4}, 0.0, 0.0);
  Motion<DoubleLanes> motion = at_rest<DoubleLanes>(model);
  for (std::size_t i = 0; i < motion.places.size(); ++i)
    if (static_cast<int>(i) >= bridge.mesh.block_nodes[1].begin) set_lane(motion.places[i].x, 2, 5.0);
  for (int l = 0; l < 4; ++l) search_contacts(model, 0.01, l, motion);
  const std::vector<bool> all_there(bridge.layout.size(), false);
  const std::vector<EdgePair> side_by_side = model.search.candidates(bridge.mesh.nodes, all_there, 0.01);
  REQUIRE(!side_by_side.empty());
  CHECK(motion.pairs == side_by_side);
  motion.shear.front() = {DoubleLanes{} + 1e-6, DoubleLanes{} + 2e-6};
  place_scene(model, {false, true}, 1, motion);
  search_contacts(model, 0.01, 1, motion);
  REQUIRE(motion.pairs == side_by_side);
  for (const Cell<DoubleLanes>& found : motion.found)
    for (int l = 0; l < 4; ++l) CHECK(lane(found.value, l) == (l == 0 || l == 3 ? 1.0 : 0.0));
  for (int l = 0; l < 4; ++l) CHECK(lane(motion.shear.front().at_1, l) == (l == 1 ? 0.0 : 2e-6));
  CHECK(lane(motion.travel, 1) == 0.0);
}

}  // namespace voussoir
