/// @file Known answers of one or two blocks in motion.

#include <fmt/format.h>
#include <numbers>

#include "core/motion/critical_step.h"
#include "core/motion/motion_step.h"
#include "tools/validation/assemblies.h"
#include "tools/validation/studies.h"

namespace voussoir::validation {
namespace {

using One = double;
constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kGravity = 9.81;

/// Blocks in motion without damping but for the contacts'.
struct MovingBlocks {
  MovingBlocks(const Model& bridge, double size, double share_of_critical, double contact_damping)
      : model(bridge, make_block_bodies(bridge, RotationalInertia::exact),
              Pace{share_of_critical * critical_step(bridge,
                                                     make_block_bodies(bridge, RotationalInertia::exact),
                                                     Integrator::implicit_blocks, contact_damping)},
              0.0, contact_damping),
        motion(at_rest<One>(model)),
        margin(0.02 * size) {}

  void step() {
    if (motion.travel > 0.4 * margin) search_contacts(model, margin, 0, motion);
    take_implicit_step(model, motion);
    time += model.step();
  }
  BlockFrame<One>& frame(std::size_t block) { return motion.frames[block]; }

  MotionModel model;
  Motion<One> motion;
  double margin;
  double time = 0.0;
};

struct Slide {
  double acceleration;  ///< down the slope [m/s2]
  double speed;         ///< at the end [m/s]
};

/// Gravity comes over 0.1 s, then the block is watched for 0.3 s; times grow with the root of the size.
/// Contacts are damped, for a block that slides with its joint partly open chatters on it otherwise (mu =
/// 0.7).
Slide slide(double slope, double friction_angle, double size) {
  const Model bridge = block_on_wedge(slope, friction_angle, size);
  const double unit = std::sqrt(size);
  MovingBlocks blocks(bridge, size, 0.3, 1e-3 * unit);
  const auto speed = [&] {
    const Pair<One>& v = blocks.frame(1).velocity;
    return v.x * std::cos(slope) - v.y * std::sin(slope);
  };
  double early = 0.0;
  double early_time = 0.0;
  while (blocks.time < 0.4 * unit) {
    blocks.motion.load = std::min(1.0, blocks.time / (0.1 * unit));
    blocks.step();
    if (early_time == 0.0 && blocks.time > 0.2 * unit) {
      early = speed();
      early_time = blocks.time;
    }
  }
  return {(speed() - early) / (blocks.time - early_time), speed()};
}

Case sliding_case(double slope, double mu, double size) {
  return relative_case({.name = fmt::format("Block on an incline of {:.0f} deg, mu = {}, size {:g}",
                                            slope / kDegree, mu, size),
                        .quantity = "acceleration [m/s2]",
                        .expected = kGravity * (std::sin(slope) - mu * std::cos(slope)),
                        .source = "g (sin a - mu cos a)",
                        .computed = slide(slope, std::atan(mu), size).acceleration},
                       1e-3,
                       "contacts resist what they see 1 ms later, so friction follows a change of the "
                       "pressure by that much of a "
                       "second");
}

Findings incline() {
  Findings findings;
  for (const double degrees : {10.0, 20.0, 30.0, 34.0}) {
    const Slide held = slide(degrees * kDegree, 35.0 * kDegree, 1.0);
    findings.cases.push_back(absolute_case(
        {.name = fmt::format("Block on an incline of {:.0f} deg below phi = 35 deg", degrees),
         .quantity = "speed after 0.4 s [m/s]",
         .expected = 0.0,
         .source = "it sticks",
         .computed = held.speed},
        kGravity * std::sin(degrees * kDegree) / 290.0,
        "it sways on its elastic joint: g sin a / omega with omega = sqrt(p_t A / m) = 290 1/s"));
  }
  for (const double size : {1.0, 0.1, 0.001})
    findings.cases.push_back(sliding_case(30.0 * kDegree, 0.2, size));
  for (const double degrees : {20.0, 40.0})
    findings.cases.push_back(sliding_case(degrees * kDegree, 0.2, 1.0));
  findings.cases.push_back(sliding_case(40.0 * kDegree, 0.7, 1.0));
  return findings;
}

/// Two blocks of E / p_n = 1000 m thrown at each other, frictionless.
Findings impact() {
  constexpr double kSpeed = 1.0;
  Model bridge = floating_course(2, 0.0);
  for (Material& material : bridge.parameters.blocks) material.young_modulus = 1e13;
  MovingBlocks blocks(bridge, 1.0, 0.01, 0.0);
  blocks.frame(0).velocity = {kSpeed, 0.0};
  const double mass = blocks.model.bodies[0].mass;
  double touching = 0.0;
  while (blocks.time < 0.05) {
    const double before = blocks.frame(1).velocity.x;
    blocks.step();
    if (blocks.frame(1).velocity.x - before > 1e-9 * kSpeed) touching += blocks.model.step();
  }
  const double stiffness = 0.5 * bridge.parameters.contact.normal_stiffness;  // face of 0.5 m x 1 m
  const double duration = std::numbers::pi * std::sqrt(0.5 * mass / stiffness);
  const std::string reason =
      "the blocks' own vibrations, which the step damps, take a share of p_n L / E = 1e-4";
  Findings findings;
  findings.cases = {absolute_case({.name = "Elastic impact of two equal blocks",
                                   .quantity = "speed of the first afterwards over its speed before",
                                   .expected = 0.0,
                                   .source = "momentum and energy: the blocks exchange their speeds",
                                   .computed = static_cast<double>(blocks.frame(0).velocity.x) / kSpeed},
                                  1e-3, reason),
                    relative_case({.name = "Elastic impact of two equal blocks",
                                   .quantity = "speed of the second afterwards over the first's before",
                                   .expected = 1.0,
                                   .source = "momentum and energy: the blocks exchange their speeds",
                                   .computed = static_cast<double>(blocks.frame(1).velocity.x) / kSpeed},
                                  1e-3, reason),
                    relative_case({.name = "Elastic impact of two equal blocks",
                                   .quantity = "time in contact [s]",
                                   .expected = duration,
                                   .source = "half a period of two masses on the joint, pi sqrt(m / 2 p_n A)",
                                   .computed = touching},
                                  0.01, "two steps of a 300th of the duration")};
  return findings;
}

/// A slender block on a clamped slab; b and h are half its width and height. It stands on two narrow feet, so
/// that it strikes the slab with its far corner, as Housner assumes.
struct Rocker {
  double half_width = 0.2;
  double half_height = 1.0;
  double foot = 0.02;     ///< width of a foot [m]
  double hollow = 0.002;  ///< height of a foot [m]
  double normal_stiffness = 1e13;

  double slenderness() const { return std::atan(half_width / half_height); }
  double radius() const { return std::hypot(half_width, half_height); }
  double weight() const { return 4.0 * half_width * half_height * 2400.0 * kGravity; }
  double rate() const { return std::sqrt(3.0 * kGravity / (4.0 * radius())); }
  /// Height of the centre above its lowest, over the radius, when it leans by an angle.
  double lift(double angle) const {
    return std::cos(slenderness() - std::abs(angle)) - std::cos(slenderness());
  }
  /// Elastic joint: the block turns about a point this far inside its edge when it leans by an angle [m].
  double inset(double angle) const { return std::sqrt(2.0 * weight() / (normal_stiffness * angle)) / 3.0; }
};

Model rocking_bridge(const Rocker& rocker) {
  BridgeDescription description;
  description.wall.length = 100.0;
  description.supports.sides = SupportKind::free;
  description.material.young_modulus = 100.0 * rocker.normal_stiffness;
  description.joints = {.normal_stiffness = rocker.normal_stiffness,
                        .tangential_stiffness = rocker.normal_stiffness,
                        .friction_angle = std::atan(2.0)};
  const double b = rocker.half_width;
  const double top = 2.0 * rocker.half_height;
  const Polygon outline = {{-b, 0.0},
                           {rocker.foot - b, 0.0},
                           {rocker.foot - b, rocker.hollow},
                           {b - rocker.foot, rocker.hollow},
                           {b - rocker.foot, 0.0},
                           {b, 0.0},
                           {b, top},
                           {-b, top}};
  return assemble_blocks(description, {rectangle({10.0, 0.0}, 2.0, 0.5), turned(outline, 0.0, {11.0, 0.5})});
}

/// Leans the second block by an angle over its right lower corner, at rest.
void lean(const Rocker& rocker, double angle, MovingBlocks& blocks) {
  const Point pivot(11.0 + rocker.half_width, 0.5);
  const auto place = [&](const Point& x) {
    const Point arm = x - pivot;
    return Pair<One>{pivot.x() + std::cos(angle) * arm.x() + std::sin(angle) * arm.y(),
                     pivot.y() - std::sin(angle) * arm.x() + std::cos(angle) * arm.y()};
  };
  const BlockBody& body = blocks.model.bodies[1];
  blocks.frame(1).centre = place(body.centre);
  blocks.frame(1).rotation = {std::cos(angle), -std::sin(angle)};
  for (int node = body.nodes.begin; node < body.nodes.end; ++node)
    blocks.motion.places[static_cast<std::size_t>(node)] =
        place(blocks.model.structure->mesh.nodes.col(node));
}

double leaning(MovingBlocks& blocks) {
  const Pair<One>& rotation = blocks.frame(1).rotation;
  return -std::atan2(static_cast<double>(rotation.y), static_cast<double>(rotation.x));
}

struct Rocking {
  double quarter_period;  ///< until the first impact [s]
  double rebound;         ///< largest lean to the other side [rad]
};

Rocking rock(const Rocker& rocker, double start, double contact_damping) {
  const Model bridge = rocking_bridge(rocker);
  MovingBlocks blocks(bridge, 1.0, 0.5, contact_damping);
  blocks.motion.load = 1.0;
  lean(rocker, start, blocks);
  while (leaning(blocks) > 0.0 && blocks.time < 10.0) blocks.step();
  Rocking result{.quarter_period = blocks.time, .rebound = 0.0};
  while (blocks.time < 2.0 * result.quarter_period) {
    blocks.step();
    result.rebound = std::max(result.rebound, -leaning(blocks));
  }
  return result;
}

Findings rocking() {
  Findings findings;
  const Rocker rocker;
  const double alpha = rocker.slenderness();
  const double drop = 1.5 * std::sin(alpha) * std::sin(alpha);
  // Contacts damped critically for the block that bounces on its feet.
  const double bounce = std::sqrt(rocker.normal_stiffness * 2.0 * rocker.foot * kGravity / rocker.weight());
  for (const double share : {0.25, 0.5, 0.75}) {
    const double start = share * alpha;
    const Rocking rocked = rock(rocker, start, 2.0 / bounce);
    const std::string name = fmt::format("Rocking block, released at {} of its slenderness", share);
    findings.cases.push_back(relative_case(
        {.name = name,
         .quantity = "quarter period [s]",
         .expected = std::acosh(1.0 / (1.0 - share)) / rocker.rate(),
         .source = "Housner 1963, T/4 = acosh(1 / (1 - theta/alpha)) / p",
         .computed = rocked.quarter_period},
        0.25 * alpha * alpha + 4.0 * rocker.inset(start) / rocker.half_width,
        "Housner's formula is linear in the slenderness, alpha^2 / 4 = 1 %; the corner gives way by less"));
    findings.cases.push_back(relative_case(
        {.name = name,
         .quantity = "angular speed after the impact over that before",
         .expected = 1.0 - drop,
         .source = "Housner 1963, 1 - 3/2 sin^2 alpha",
         .computed = std::sqrt(rocker.lift(rocked.rebound) / rocker.lift(start))},
        drop * rocker.foot / rocker.half_width,
        "it strikes with a foot, not with a corner: half the width is uncertain by half a foot, 5 %, and "
        "the drop by twice that"));
  }
  return findings;
}

}  // namespace

std::vector<Study> motion_studies() {
  return {{.name = "incline", .title = "Block on an incline", .run = incline},
          {.name = "impact", .title = "Elastic impact of two blocks", .run = impact},
          {.name = "rocking", .title = "Rocking block", .run = rocking}};
}

}  // namespace voussoir::validation
