/// @file What goes through joints and blocks. Oracles: balance of forces and moments of every block, closed
/// forms, mirror images.

#include "core/statics/joint_forces.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/statics/stresses.h"
#include "core/statics/thrust_line.h"
#include "tests/support/bridges.h"
#include "tools/validation/assemblies.h"
#include "tools/validation/history.h"

using namespace voussoir;

namespace {

/// A bridge at the end of a history, with the equations of its last stage.
struct Solved {
  Model bridge;
  EquilibriumSystem system;
  Coefficients coefficients;
  StageEquations equations;
  Field displacement;

  /// The stages stand, the last one in one step.
  Solved(const Model& model, const validation::History& history)
      : bridge(model),
        system(bridge),
        coefficients(system, bridge.parameters),
        equations(system, coefficients, history.stages.back().stage) {
    QuasiStaticSolver solver(bridge);
    std::vector<Solution> solutions = validation::solve_history(solver, history);
    REQUIRE(solutions.size() == history.stages.size());
    REQUIRE(stands(solutions.back()));
    const Solution& last = solutions.back();
    if (has_slipped(last))
      equations.memory = memory_of_slip(last.slipped);
    else if (solutions.size() > 1)
      equations.memory = solutions[solutions.size() - 2].memory;
    displacement = without_nan(solutions.back().displacement);
  }

  std::vector<JointForces> joints() const { return joint_forces(equations, bridge.parameters, displacement); }
};

double cross_product(const Point& a, const Point& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Forces (x, y) and moment about the origin that joints and weight exert on each block [N, Nm].
Eigen::Matrix3Xd sums_over_blocks(const Solved& solved) {
  const Mesh& mesh = solved.bridge.mesh;
  Eigen::Matrix3Xd sums = Eigen::Matrix3Xd::Zero(3, solved.bridge.block_count());
  const auto add = [&](BlockId block, const Point& at, const Point& force) {
    sums.col(value(block)) += Eigen::Vector3d(force.x(), force.y(), cross_product(at, force));
  };
  for (const JointForces& found : solved.joints()) {
    const Joint& joint = solved.bridge.joints[found.joint];
    for (std::size_t end = 0; end < 2; ++end) {
      const Point from = solved.displacement.col(value(joint.first_edge.from));
      const Point to = solved.displacement.col(value(joint.first_edge.to));
      const Point at = found.ends.at(end) + from + joint.first_at.at(end) * (to - from);
      add(joint.second, at, found.on_second.at(end));
      add(joint.first, at, -found.on_second.at(end));
    }
  }
  for (std::size_t block = 0; block < mesh.block_nodes.size(); ++block)
    for (int node = mesh.block_nodes[block].begin; node < mesh.block_nodes[block].end; ++node)
      if (!solved.equations.removed[block])
        add(BlockId{static_cast<std::int32_t>(block)}, mesh.nodes.col(node) + solved.displacement.col(node),
            {0.0, -solved.coefficients.weight[node]});
  return sums;
}

bool is_held(const Structure& bridge, BlockId block) {
  const IndexRange nodes = bridge.mesh.block_nodes[static_cast<std::size_t>(value(block))];
  const double length = bridge.mesh.nodes.row(0).maxCoeff();
  for (int node = nodes.begin; node < nodes.end; ++node)
    if (bridge.mesh.nodes(1, node) == 0.0 || bridge.mesh.nodes(0, node) == 0.0 ||
        bridge.mesh.nodes(0, node) == length)
      return true;
  return false;
}

}  // namespace

TEST_CASE("Joints' forces carry the weight of every block that no support holds", "[joint]") {
  const Model bridge = test::small_bridge();
  for (const char* missing : {"intact", "4,2", "4,1+4,2"}) {
    const Scene scene = parse_scene(missing, bridge.layout);
    validation::History history = validation::lost(scene);
    history.stages.back().steps = 1;
    const Solved solved(bridge, scene.removed.empty() ? validation::built(scene) : history);
    const Eigen::Matrix3Xd sums = sums_over_blocks(solved);
    const double weight = solved.coefficients.weight.sum() / bridge.block_count();
    double largest = 0.0;
    for (const JointForces& joint : solved.joints()) largest = std::max(largest, joint.normal);
    int looked_at = 0;
    for (int block = 0; block < bridge.block_count(); ++block) {
      if (is_held(bridge, BlockId{block}) || scene.lacks(BlockId{block})) continue;
      ++looked_at;
      CHECK(sums.col(block).head<2>().norm() < 1e-5 * weight);
      // Faces that have slid past each other by less than a millimetre touch on the first block's edge and on
      // the second's so far apart.
      CHECK(std::abs(sums(2, block)) < 1e-3 * largest);
    }
    CHECK(looked_at > 20);
  }
}

TEST_CASE("A joint says where its faces are apart, stick and slide (point by point)", "[joint]") {
  const JointStiffness joint = joint_stiffness({1e9, 1e8, std::atan(0.5)}, 0.4);
  const JointMemory memory{1e-5, 1e-5};
  const auto expect = [&](const JointState& state) {
    constexpr int kPoints = 20000;
    double closed = 0.0, sliding = 0.0;
    for (int i = 0; i < kPoints; ++i) {
      const double s = (i + 0.5) / kPoints;
      const double depth = -((1 - s) * state[0] + s * state[2]);
      const double slip = (1 - s) * state[1] + s * state[3] - 1e-5;
      closed += depth > 0.0 ? 1.0 / kPoints : 0.0;
      sliding += depth > 0.0 && 1e8 * std::abs(slip) > 0.5e9 * depth ? 1.0 / kPoints : 0.0;
    }
    const JointContact contact = joint_contact(joint, memory, state);
    CHECK(contact.closed == Approx(closed).margin(1e-4));
    CHECK(contact.sliding == Approx(sliding).margin(1e-4));
  };
  expect({1e-5, 0.0, 2e-5, 0.0});
  expect({-1e-5, 0.0, -2e-5, 0.0});
  expect({-1e-5, 3e-5, 2e-5, 9e-5});
  expect({-1e-5, 9e-5, -2e-5, -9e-5});
  expect({1e-5, -2e-4, -2e-5, -2e-4});
}

TEST_CASE("The mean stress of a column's blocks is that of what stands on them (closed form)", "[stress]") {
  for (const PlaneState plane : {PlaneState::stress, PlaneState::strain}) {
    BridgeDescription description;
    description.supports = {.base = SupportKind::roller, .sides = SupportKind::roller};
    description.wall.length = 2.0;  // a roller at the left only
    description.material.plane = plane;
    const Model column = validation::assemble_blocks(
        description,
        {validation::rectangle(Point(0.0, 0.0), 1.0, 0.5), validation::rectangle(Point(0.0, 0.5), 1.0, 0.5)});
    const Solved solved(column, validation::built({}));
    const std::vector<TriangleStress> stresses =
        triangle_stresses(solved.equations, column.parameters, solved.displacement);
    const double weight = 2400.0 * 9.81 * 0.5;  // of a block
    for (std::size_t block = 0; block < 2; ++block) {
      // Mean stress of a body at rest: boundary tractions times places and weight times places over its area.
      const double expected = block == 0 ? -1.5 * weight : -0.5 * weight;
      double yy = 0.0, area = 0.0;
      const IndexRange range = column.mesh.block_triangles[block];
      for (int t = range.begin; t < range.end; ++t) {
        const double own = solved.system.triangles[static_cast<std::size_t>(t)].area;
        const TriangleStress& stress = stresses[static_cast<std::size_t>(t)];
        yy += own * stress.yy;
        area += own;
        CHECK(stress.zz == Approx(plane == PlaneState::stress ? 0.0 : 0.2 * (stress.xx + stress.yy)));
        CHECK(stress.tresca >= std::abs(stress.yy - stress.xx) * (1.0 - 1e-12));
      }
      CHECK(yy / area == Approx(expected).epsilon(1e-5));
    }
  }
}

TEST_CASE("Tresca stress of pulled and sheared triangles (Mohr's circle), and stress turns with the block",
          "[stress]") {
  const TriangleShape shape = triangle_shape({0, 0}, {1, 0}, {0, 1});
  const PlaneModuli moduli = plane_moduli(Material{});
  const double pull = 1e-7;
  Vector6d q = Vector6d::Zero();
  q[2] = pull;  // u_x = pull x
  const Eigen::Vector3d pulled = cauchy_stress(shape, moduli, q);
  CHECK(pulled[0] == Approx(moduli.a * pull).epsilon(1e-6));
  CHECK(pulled[1] == Approx(moduli.b * pull).epsilon(1e-6));
  // The pulled triangle, turned by 90 degrees: x and y change places.
  Vector6d turned;
  const std::array<Point, 3> at = {Point(0, 0), Point(1 + pull, 0), Point(0, 1)};
  const std::array<Point, 3> rest = {Point(0, 0), Point(1, 0), Point(0, 1)};
  for (int i = 0; i < 3; ++i) {
    const Point& place = at.at(static_cast<std::size_t>(i));
    turned.segment<2>(2 * i) = Point(-place.y(), place.x()) - rest.at(static_cast<std::size_t>(i));
  }
  const Eigen::Vector3d after = cauchy_stress(shape, moduli, turned);
  CHECK(after[0] == Approx(pulled[1]).epsilon(1e-6));
  CHECK(after[1] == Approx(pulled[0]).epsilon(1e-6));
  CHECK(std::abs(after[2]) < 1e-6 * pulled[0]);
}

TEST_CASE("A thrust line goes through the centre of pressure (closed form) and is its own mirror image",
          "[joint]") {
  const Model bridge = test::small_bridge();
  const Solved solved(bridge, validation::built({}));
  const std::vector<JointForces> joints = solved.joints();
  const std::vector<ThrustPoint> thrust = thrust_lines(bridge, joints);
  const auto ring = std::ranges::count(bridge.layout.blocks, BlockRole::ring, &Block::role);
  REQUIRE(static_cast<std::ptrdiff_t>(thrust.size()) == ring - 1);
  for (std::size_t i = 0; i < thrust.size(); ++i) {
    const ThrustPoint& image = thrust[thrust.size() - 1 - i];
    CHECK(thrust[i].eccentricity == Approx(image.eccentricity).margin(1e-9));
    CHECK(thrust[i].normal == Approx(image.normal).epsilon(1e-7));
    CHECK(std::abs(thrust[i].eccentricity) < 0.5 * thrust[i].thickness);
  }
  // Pressures p_0 and p_1 at the ends of one closed stretch of length h press at h (p_1 - p_0) / (6 (p_1 +
  // p_0)) from its middle.
  int looked_at = 0;
  for (const JointForces& joint : joints) {
    const Joint& where = bridge.joints[joint.joint];
    const auto found = std::ranges::find_if(thrust, [&](const ThrustPoint& point) {
      return point.first == where.first && point.second == where.second;
    });
    const double length = (joint.ends[1] - joint.ends[0]).norm();
    if (found == thrust.end() || joint.closed_share < 1.0 || length < 0.999 * found->thickness) continue;
    const double along =
        length * (joint.pressure[1] - joint.pressure[0]) / (6.0 * (joint.pressure[1] + joint.pressure[0]));
    const double outward = (joint.ends[1] - joint.ends[0]).dot(found->outward) > 0.0 ? along : -along;
    CHECK(found->eccentricity == Approx(outward).epsilon(1e-3));  // forces turn with the joint, by less
    ++looked_at;
  }
  CHECK(looked_at > 3);
}
