/// @file Paths of prescribed movement. Oracles: closed forms of a joint pulled and slid, the first law,
/// refined meshes.

#include "tools/validation/path.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tools/validation/assemblies.h"

using namespace voussoir;
using namespace voussoir::validation;

namespace {

constexpr double kLength = 0.22, kHeight = 0.0625, kThickness = 0.1;
constexpr double kArea = kLength * kThickness;
constexpr double kStrength = 0.25e6, kOpeningEnergy = 18.0, kCohesion = 0.35e6, kSlipEnergy = 125.0;
constexpr double kFriction = 0.75, kNormal = 82e9;

/// Two bricks with a joint of mortar, clamped below; all that lies at the upper edge is the support "top".
Model couplet(int refinement, double young_modulus = 16.7e9) {
  BridgeDescription description;
  description.material = {
      .young_modulus = young_modulus, .poisson_ratio = 0.0, .density = 1900.0, .thickness = kThickness};
  description.joints = {.normal_stiffness = kNormal,
                        .tangential_stiffness = 36e9,
                        .friction_angle = std::atan(kFriction),
                        .mortar = {.tensile_strength = kStrength,
                                   .opening_energy = kOpeningEnergy,
                                   .cohesion = kCohesion,
                                   .slip_energy = kSlipEnergy,
                                   .friction_angle = std::atan(kFriction)}};
  description.supports = {.base = SupportKind::clamped, .sides = SupportKind::free};
  description.wall.length = kLength;
  description.mesh.refinement = refinement;
  description.gravity = 0.0;
  Model model = assemble_blocks(
      description, {rectangle({0.0, 0.0}, kLength, kHeight), rectangle({0.0, kHeight}, kLength, kHeight)});
  Support top{.name = "top", .nodes = {}, .holds_x = true, .holds_y = true};
  for (int node = 0; node < model.mesh.node_count(); ++node)
    if (model.mesh.nodes(1, node) > 2.0 * kHeight - 1e-9) top.nodes.push_back(NodeId{node});
  model.supports.push_back(top);
  return model;
}

/// What a path shows from outside.
struct Outside {
  double strongest_x = 0.0, strongest_y = 0.0;  ///< [N] force of the top on the bricks
  double work = 0.0;                            ///< [J] done by the top, trapezoidal
  double dissipated = 0.0;                      ///< [J] by the mortar's law
  double largest_rise = 0.0;                    ///< most negative dissipation of a step [J]
  State end;
  bool complete = false;
};

/// Moves the top's nodes as a rigid body: by `way` and by an angle about the top's middle.
Field movement(const Model& model, const Point& way, double angle) {
  Field field = Field::Zero(2, model.mesh.node_count());
  for (const NodeId node : model.supports.back().nodes) {
    const double arm = model.mesh.position(node).x() - 0.5 * kLength;
    field.col(value(node)) = way + Point(0.0, angle * arm);
  }
  return field;
}

Outside follow(const Model& model, const Field& from, const Field& to, const State& start, int steps) {
  const EquilibriumSystem system(model);
  const Coefficients coefficients(system, model.parameters);
  const Path path = follow_path(
      system, coefficients,
      {.from = {.support_movement = from}, .to = {.support_movement = to}, .start = start}, {.steps = steps});
  Outside outside;
  outside.complete = path.complete;
  Field force = support_forces(StageEquations(system, coefficients, {.support_movement = from}, start.memory),
                               start.displacement);
  double share = 0.0;
  for (const PathPoint& point : path.points) {
    const Point sum = point.support_forces.rowwise().sum();
    Point top = Point::Zero();
    for (const NodeId node : model.supports.back().nodes) top += point.support_forces.col(value(node));
    CHECK(sum.norm() < 1e-4 * kStrength * kArea);
    outside.strongest_x = std::max(outside.strongest_x, top.x());
    outside.strongest_y = std::max(outside.strongest_y, top.y());
    outside.work +=
        (point.share - share) * (0.5 * (force + point.support_forces)).cwiseProduct(to - from).sum();
    outside.largest_rise = std::min(outside.largest_rise, point.dissipated - outside.dissipated);
    outside.dissipated = point.dissipated;
    force = point.support_forces;
    share = point.share;
    outside.end = point.state;
  }
  return outside;
}

State at_rest(const Model& model) {
  return {Field::Zero(2, model.mesh.node_count()), {}};
}

}  // namespace

TEST_CASE("A couplet pulled apart: strength f_t and energy G_I (closed form), on every mesh",
          "[mortar][path][many-solutions]") {
  for (const int refinement : {0, 1, 2}) {
    const Model model = couplet(refinement);
    const Outside pulled =
        follow(model, movement(model, {0, 0}, 0), movement(model, {0, 1e-3}, 0), at_rest(model), 1000);
    REQUIRE(pulled.complete);
    CHECK(pulled.strongest_y == Approx(kStrength * kArea).epsilon(0.01));
    CHECK(pulled.dissipated == Approx(kOpeningEnergy * kArea).epsilon(0.01));
    CHECK(pulled.work == Approx(kOpeningEnergy * kArea).epsilon(0.01));
    CHECK(pulled.largest_rise >= 0.0);
  }
}

TEST_CASE("A couplet slid under pressure: strength c + mu p and energy G_II beside friction (closed form)",
          "[mortar][path][many-solutions]") {
  constexpr double kPressure = 0.3e6, kFar = 4e-3,
                   kStiff = 1e12;  // bricks hardly bend: the joint is loaded evenly
  constexpr double kWay = kPressure * (1.0 / kNormal + 2.0 * kHeight / kStiff);
  for (const int refinement : {0, 1, 2}) {
    const Model model = couplet(refinement, kStiff);
    const Field pressed = movement(model, {0, -kWay}, 0);
    const Outside before = follow(model, movement(model, {0, 0}, 0), pressed, at_rest(model), 1);
    const Field slid = movement(model, {kFar, -kWay}, 0);
    const Outside outside = follow(model, pressed, slid, before.end, 1000);
    REQUIRE(outside.complete);
    CHECK(outside.strongest_x == Approx((kCohesion + kFriction * kPressure) * kArea).epsilon(0.01));
    const double friction = kFriction * kPressure * kFar * kArea;
    const double elastic =
        std::pow(kFriction * kPressure, 2) / 36e9 * kArea;  // at the end, with its friction
    const double left = kSlipEnergy * std::exp(-kCohesion * kFar / kSlipEnergy) * kArea;
    CHECK(outside.dissipated - friction + elastic + left == Approx(kSlipEnergy * kArea).epsilon(0.01));
  }
}

TEST_CASE("A couplet pulled open from one end, or slid and turned: the same on every mesh (refined meshes)",
          "[mortar][path][many-solutions]") {
  const auto way = GENERATE(std::make_pair(Point(0.0, 0.0), 2e-3), std::make_pair(Point(2e-4, 1e-4), 1e-3));
  const double young_modulus = GENERATE(1e12, 16.7e9);  // bricks that bend need finer triangles themselves
  const std::vector<int> refinements = young_modulus == 1e12 ? std::vector{2, 3, 4} : std::vector{3, 4};
  std::vector<Outside> outside;
  for (const int refinement : refinements) {
    const Model model = couplet(refinement, young_modulus);
    outside.push_back(follow(model, movement(model, {0, 0}, 0), movement(model, way.first, way.second),
                             at_rest(model), 200));
    REQUIRE(outside.back().complete);
    CHECK(outside.back().largest_rise >= 0.0);
  }
  const double force = outside.back().strongest_x + outside.back().strongest_y;
  for (const Outside& one : outside) {
    CHECK(one.dissipated == Approx(outside.back().dissipated).epsilon(0.02));
    CHECK(one.strongest_x + one.strongest_y == Approx(force).epsilon(0.02));
  }
}

TEST_CASE("A step too far is cut, and a snap is followed to an equilibrium (the path's own residual)",
          "[mortar][path]") {
  Model model = couplet(1, 2e8);  // soft bricks let go more than the joint can take: the force snaps
  const Outside outside =
      follow(model, movement(model, {0, 0}, 0), movement(model, {0, 1e-3}, 0), at_rest(model), 5);
  REQUIRE(outside.complete);
  CHECK(outside.strongest_y <= kStrength * kArea * 1.001);
  const EquilibriumSystem system(model);
  const Coefficients coefficients(system, model.parameters);
  const StageEquations equations(system, coefficients, {.support_movement = movement(model, {0, 1e-3}, 0)},
                                 outside.end.memory);
  CHECK(unbalanced_forces(equations, outside.end.displacement).cwiseAbs().maxCoeff() <
        1e-6 * kStrength * kArea);
}
