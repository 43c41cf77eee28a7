#include "core/motion/pace.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/motion/dynamic_solver.h"
#include "core/motion/motion_step.h"
#include "tests/support/bridges.h"
#include "tools/validation/assemblies.h"

using namespace voussoir;

namespace {

DynamicSettings plain(double step) {
  DynamicSettings settings;
  settings.step = step;
  return settings;
}

Field known(const Field& field) {
  return field.array().isNaN().select(0.0, field);
}

}  // namespace

TEST_CASE("The reference bridge takes long steps but for the pieces beside the ring", "[motion]") {
  const Model bridge = test::reference_bridge();
  const Pace pace = DynamicSolver(bridge).pace();
  CHECK(pace.parts > 1);
  for (const char* text : {"10,10", "10,11"})  // slivers of 0.019 m2
    CHECK(pace.is_quick(static_cast<std::size_t>(value(parse_scene(text, bridge.layout).removed.front()))));
  for (const char* text : {"10,4", "0,10", "1,3"})
    CHECK_FALSE(
        pace.is_quick(static_cast<std::size_t>(value(parse_scene(text, bridge.layout).removed.front()))));
}

TEST_CASE("Equal blocks take equal steps", "[motion]") {
  CHECK(DynamicSolver(validation::floating_course(4, 0.6)).pace().parts == 1);
}

TEST_CASE("What falls when few blocks take short steps falls as when all do (motion in steps of 0.05 ms)",
          "[motion][many-solutions]") {
  const Model bridge = test::reference_bridge();
  std::vector<Scene> scenes;
  for (const char* text : {"0,5", "0,10+10,11", "0,9+10,12", "0,3"})
    scenes.push_back(parse_scene(text, bridge.layout));
  const std::vector<DynamicSolution> found = DynamicSolver(bridge).solve(scenes);
  const std::vector<DynamicSolution> expected = DynamicSolver(bridge, plain(5e-5)).solve(scenes);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    INFO(to_string(scenes[i], bridge.layout));
    CHECK(found[i].solution.outcome == expected[i].solution.outcome);
    CHECK(found[i].solution.extent == expected[i].solution.extent);
    CHECK(found[i].time == Approx(0.3).margin(1e-9));
    const Field exact = known(expected[i].solution.displacement);
    const double difference = (known(found[i].solution.displacement) - exact).cwiseAbs().sum();
    CHECK(difference < 0.005 * exact.cwiseAbs().sum());
  }
}

TEST_CASE("A quick block that collides with others keeps their linear momentum (conservation laws)",
          "[motion]") {
  const Model bridge = validation::floating_course(3, 0.6);
  const Pace pace{.step = 6e-5, .parts = 3, .quick = {false, true, false}};
  const MotionModel model(bridge, make_block_bodies(bridge, RotationalInertia::exact), pace, 0.0, 0.0);
  Motion<double> motion = at_rest<double>(model);
  motion.frames[0].velocity = {1.5, 0.3};
  motion.frames[2].velocity = {-2.0, 0.4};
  const auto momentum = [&] {
    Point sum = Point::Zero();
    for (std::size_t b = 0; b < 3; ++b)
      sum += model.bodies[b].mass * Point(motion.frames[b].velocity.x, motion.frames[b].velocity.y);
    return sum;
  };
  const Point before = momentum();
  for (int i = 0; i < 5000; ++i) {
    if (motion.travel > 0.005) search_contacts(model, 0.01, 0, motion);
    take_implicit_step(model, motion);
  }
  CHECK((momentum() - before).norm() <= 1e-12 * before.norm());
  CHECK(std::abs(motion.frames[2].velocity.x + 2.0) > 0.1);  // they have met
}
