#include "core/motion/softening.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "core/bridge_file/bridge_file.h"
#include "core/motion/critical_step.h"
#include "core/motion/dynamic_solver.h"
#include "tests/support/bridges.h"

using namespace voussoir;

namespace {

/// Two equal blocks one on the other, the lower one held.
Model column(double normal_stiffness) {
  BridgeDescription bridge;
  bridge.spans.clear();
  bridge.wall = {.length = 1.0, .courses = 2, .course_height = 0.5, .block_length = 1.0, .bond = Bond::stack};
  bridge.joints.normal_stiffness = normal_stiffness;
  bridge.joints.tangential_stiffness = 0.1 * normal_stiffness;
  bridge.supports.sides = SupportKind::free;
  return make_model(bridge);
}

/// Three arches, one of whose extrados leaves a stone of the spandrel a corner of 7 mm, between stiff joints
/// (seed 1008 of benchmark-bridges).
BridgeDescription bridge_with_a_corner() {
  BridgeDescription bridge;
  bridge.wall = {.length = 37.54176826530192,
                 .courses = 14,
                 .course_height = 0.47970932536228234,
                 .block_length = 0.5965398461375865,
                 .bond = Bond::stack,
                 .smallest_block = kSmallestBlock};
  const SpanDescription span{.centre_y = 0.9367398489360967,
                             .intrados_radius = 3.3591525501936483,
                             .ring_thickness = 0.6126147726620681,
                             .voussoirs = 19};
  bridge.spans = {span, span, span};
  bridge.spans[0].centre_x = 9.591080436269651;
  bridge.spans[1].centre_x = 18.770884132650963;
  bridge.spans[2].centre_x = 27.950687829032276;
  bridge.material.young_modulus = 2.495596111883537e9;
  bridge.joints.normal_stiffness = 2.374785484402586e10;
  bridge.joints.tangential_stiffness = 3.6716654705212906e7;
  return bridge;
}

}  // namespace

TEST_CASE("Joints are softened until a block alone allows the step (its critical step, and none longer)",
          "[motion]") {
  const DynamicSettings settings;
  const auto step_of = [&](const Model& model) {
    DynamicSettings as_they_are = settings;
    as_they_are.least_step = 0.0;
    return DynamicSolver(model, as_they_are).critical_step();
  };
  const Model stiff = column(1e12);
  REQUIRE(step_of(stiff) < 0.2 * settings.least_step);
  const std::vector<BlockBody> bodies = make_block_bodies(stiff, settings.inertia);
  const std::vector<double> share = softening(stiff, bodies, settings.contact_damping, settings.least_step);
  const Model soft = softened(stiff, share);
  const auto step_alone = [&](std::size_t block) {
    std::vector<bool> still(bodies.size(), true);
    still[block] = false;
    return critical_step(soft, bodies, settings.integrator, settings.contact_damping, still);
  };
  // Iterated from above until it changes by no more than a hundredth.
  const double shorter = std::min(step_alone(0), step_alone(1));
  CHECK(shorter > 0.99 * settings.least_step);
  CHECK(shorter < 1.05 * settings.least_step);
  // Two blocks that swing against each other allow less than one alone, and are as soft as that in motion.
  CHECK(step_of(soft) < 1.01 * settings.least_step);
  CHECK(DynamicSolver(stiff, settings).critical_step() == Approx(step_of(soft)));
  CHECK(soft.parameters.joints[0].normal_stiffness / stiff.parameters.joints[0].normal_stiffness ==
        Approx(soft.parameters.joints[0].tangential_stiffness /
               stiff.parameters.joints[0].tangential_stiffness));
  CHECK(soft.parameters.joints[0].friction_angle == stiff.parameters.joints[0].friction_angle);
}

TEST_CASE("A corner of 7 mm does not shorten steps without end (near half of what each block alone allows)",
          "[motion]") {
  const Model bridge = make_model(bridge_with_a_corner());
  const DynamicSettings settings;
  const std::vector<BlockBody> bodies = make_block_bodies(bridge, settings.inertia);
  const Model as_blocks_alone_ask =
      softened(bridge, softening(bridge, bodies, settings.contact_damping, settings.least_step));
  REQUIRE(critical_step(as_blocks_alone_ask, bodies, settings.integrator, settings.contact_damping) <
          0.2 * settings.least_step);
  CHECK(DynamicSolver(bridge, settings).critical_step() > 0.4 * settings.least_step);
}

TEST_CASE("The reference bridge's joints are soft enough for every step (bit by bit)", "[motion]") {
  const Model model = make_model({});
  const DynamicSettings settings;
  for (const double share : softening(model, make_block_bodies(model, settings.inertia),
                                      settings.contact_damping, settings.least_step))
    CHECK(share == 1.0);
}

TEST_CASE("What falls from softened joints falls as from the joints as they are (motion in short steps)",
          "[motion]") {
  BridgeDescription description = read_bridge_file(test::example_bridge("small")).description;
  description.joints.normal_stiffness *= 30.0;
  description.joints.tangential_stiffness *= 30.0;
  const Model model = make_model(description);
  DynamicSettings exact;
  exact.least_step = 0.0;
  exact.most_parts = 1;
  const DynamicSolver short_steps(model, exact);
  DynamicSolver solver(model);
  REQUIRE(short_steps.step() < 0.6 * solver.step());
  for (const char* text : {"0,5", "0,2", "0,4+0,7"}) {
    const Scene scene = parse_scene(text, model.layout);
    const Solution soft = solver.solve(scene).solution;
    const Solution stiff = DynamicSolver(model, exact).solve(scene).solution;
    INFO(text);
    CHECK(soft.outcome == stiff.outcome);
    CHECK(soft.extent == stiff.extent);
    const auto known = [](const Field& field) { return field.array().isNaN().select(0.0, field.array()); };
    const double difference = (known(soft.displacement) - known(stiff.displacement)).abs().sum();
    // The small bridge has moved by 2 mm at the moment of the field; softened joints sag a tenth of that
    // more.
    CHECK(difference < 0.25 * known(stiff.displacement).abs().sum());
  }
}
