/// @file Known answers of load cases: influence lines, reciprocity, unloading.

#include <fmt/format.h>

#include "tools/validation/assemblies.h"
#include "tools/validation/history.h"
#include "tools/validation/load_runs.h"
#include "tools/validation/studies.h"

namespace voussoir::validation {
namespace {

constexpr double kPressure = 2e4;  ///< on the wall's side [Pa]: all its joints are closed, and none slips

/// Vertical displacement at a place [m], the mean of all nodes there.
double settlement(const Model& bridge, const Field& field, const Point& place) {
  double sum = 0.0;
  int count = 0;
  for (int node = 0; node < bridge.mesh.node_count(); ++node)
    if ((bridge.mesh.nodes.col(node) - place).norm() < 1e-9) {
      sum += field(1, node);
      ++count;
    }
  return sum / count;
}

/// Computed influence line against the expected one: largest difference over the largest value.
Case influence_case(const std::string& name, const std::string& source, const Eigen::MatrixXd& computed,
                    const Eigen::MatrixXd& expected, double tolerance, const std::string& reason) {
  Case known{.name = name,
             .quantity = "largest settlement of the influence lines [m]",
             .expected = expected.cwiseAbs().maxCoeff(),
             .source = source,
             .computed = computed.cwiseAbs().maxCoeff(),
             .error = (computed - expected).cwiseAbs().maxCoeff() / expected.cwiseAbs().maxCoeff(),
             .tolerance = tolerance,
             .reason = reason};
  return known;
}

/// Two blocks of 1 m x 0.5 m on a third that is clamped: a force at x on top, settlement of the corners.
Findings column_influence() {
  constexpr double kForce = 1e3;  // moves the thrust by 4 cm, the joints stay closed to 17 cm
  const Model bridge = column(3, 1e16);
  QuasiStaticSolver solver(bridge);
  const Point left(0.0, 1.5);
  const Point right(1.0, 1.5);
  const auto node_at = [&](const Point& place) {
    Eigen::Index node = 0;
    (bridge.mesh.nodes.colwise() - place).colwise().squaredNorm().minCoeff(&node);
    return NodeId{static_cast<std::int32_t>(node)};
  };
  const JointMaterial& joint = bridge.parameters.contact;
  constexpr int kPlaces = 5;
  Eigen::MatrixXd computed(2, kPlaces);
  Eigen::MatrixXd expected(2, kPlaces);
  for (int j = 0; j < kPlaces; ++j) {
    const double x = 0.25 * j;  // the block on top is rigid: the lever rule shares the force to its corners
    const Field load = point_load(bridge, node_at(left), (1.0 - x) * kForce) +
                       point_load(bridge, node_at(right), x * kForce);
    const std::vector<Solution> states = solve_history(solver, followed_by(built({}), "load", load));
    const Field change = states.back().displacement - states.front().displacement;
    computed.col(j) << settlement(bridge, change, left), settlement(bridge, change, right);
    for (int i = 0; i < 2; ++i)
      expected(i, j) = -2.0 * kForce / joint.normal_stiffness * (1.0 + 12.0 * (i - 0.5) * (x - 0.5));
  }
  return {
      .cases = {influence_case("Point load on a column of two blocks",
                               "two joints in series, 2 F (1 / k + e_i e_j / k_r)", computed, expected, 2e-4,
                               "23.5 kN lean with the blocks, 0.5 m over a joint of 83 MN m / rad: 1.4e-4")}};
}

/// Blocks of 0.5 m x 0.5 m in a row, clamped at the left, pressed together so that all joints stay closed.
struct BlockBeam {
  static constexpr int kBlocks = 8;
  static constexpr double kSize = 0.5;  ///< [m]
  double normal_stiffness;
  int refinement = 3;

  Model model() const {
    BridgeDescription description;
    description.wall.length = 1000.0;
    description.supports = {.base = SupportKind::free, .sides = SupportKind::clamped};
    description.material.poisson_ratio = 0.0;
    description.joints = {.normal_stiffness = normal_stiffness,
                          .tangential_stiffness = 0.4 * normal_stiffness,
                          .friction_angle = 1.5};
    description.gravity = 0.0;
    description.mesh.refinement = refinement;
    std::vector<Polygon> blocks;
    for (int i = 0; i < kBlocks; ++i) blocks.push_back(rectangle({kSize * i, 0.0}, kSize, kSize));
    return assemble_blocks(description, blocks);
  }

  /// Settlement at the right end of block i under a unit force there at block j: Timoshenko's cantilever, and
  /// the joints' springs.
  double influence(int i, int j) const {
    constexpr double kInertia = kSize * kSize * kSize / 12.0;
    const double e = Material{}.young_modulus;
    const double near_end = kSize * (std::min(i, j) + 1);
    const double far_end = kSize * (std::max(i, j) + 1);
    double sum = near_end * near_end * (3.0 * far_end - near_end) / (6.0 * e * kInertia) +
                 1.2 * near_end / (0.5 * e * kSize);
    for (int k = 1; k <= std::min(i, j); ++k)
      sum += (near_end - kSize * k) * (far_end - kSize * k) / (normal_stiffness * kInertia) +
             1.0 / (0.4 * normal_stiffness * kSize);
    return sum;
  }
};

/// A force [N] at the right end of every other block, half on top and half below.
Eigen::MatrixXd beam_settlements(const BlockBeam& beam, double force, double pressure) {
  const Model bridge = beam.model();
  QuasiStaticSolver solver(bridge);
  const auto corner = [&](int block, int top) {
    const IndexRange& nodes = bridge.mesh.block_nodes[static_cast<std::size_t>(block)];
    const Point place(BlockBeam::kSize * (block + 1), BlockBeam::kSize * top);
    int node = nodes.begin;
    while ((bridge.mesh.nodes.col(node) - place).norm() > 1e-9) ++node;
    return NodeId{node};
  };
  const Stage pressed{.load = side_pressure(bridge, BlockBeam::kBlocks * BlockBeam::kSize, pressure)};
  const Solution before = solver.solve({.stage = pressed});
  constexpr int kPlaces = BlockBeam::kBlocks / 2;
  Eigen::MatrixXd settlements(kPlaces, kPlaces);
  for (int j = 0; j < kPlaces; ++j) {
    Stage loaded = pressed;
    for (const int top : {0, 1}) loaded.load += point_load(bridge, corner(2 * j + 1, top), 0.5 * force);
    const Solution after = solver.solve({.stage = loaded, .start = &before.displacement, .before = &before});
    const Field change = after.displacement - before.displacement;
    for (int i = 0; i < kPlaces; ++i)
      settlements(i, j) =
          0.5 * (change(1, value(corner(2 * i + 1, 0))) + change(1, value(corner(2 * i + 1, 1))));
  }
  return settlements;
}

Case beam_case(double normal_stiffness, double force) {
  BlockBeam beam{.normal_stiffness = normal_stiffness};
  // All joints closed: the moment of the force at the end over the section modulus, and half as much again.
  const double pressure = 1.5 * force * 4.0 * 6.0 / (BlockBeam::kSize * BlockBeam::kSize);
  const Eigen::MatrixXd coarse = beam_settlements(beam, force, pressure);
  ++beam.refinement;
  const Eigen::MatrixXd fine = beam_settlements(beam, force, pressure);
  Eigen::MatrixXd expected(fine.rows(), fine.cols());
  for (int i = 0; i < expected.rows(); ++i)
    for (int j = 0; j < expected.cols(); ++j) expected(i, j) = -force * beam.influence(2 * i + 1, 2 * j + 1);
  return influence_case(
      fmt::format("Point load on a cantilever of 8 blocks, p_n = {:.0e}", normal_stiffness),
      "Timoshenko's beam and the joints' springs", fine + (fine - coarse) / 3.0, expected, 0.01,
      "two meshes extrapolated; beam theory leaves out how the clamped end and the faces warp, (depth / "
      "length)^2 = 1.6 % of the shear's share and less of the rest; the pressure softens the beam by 1e-4");
}

Findings beam_influence() {
  return {.cases = {beam_case(1e12, 100.0), beam_case(1e9, 1.0)}};
}

Findings reciprocity() {
  const Model bridge = rough_wall();
  const Stage pressed{.load = side_pressure(bridge, 4.0, kPressure)};
  std::vector<int> components;
  for (int node = 0; node < bridge.mesh.node_count(); node += 7) components.push_back(2 * node + 1);
  return {.cases = {absolute_case(
              {.name = "Wall of 14 blocks that do not slip, gravity and side pressure",
               .quantity = "largest difference of u_i(F_j) and u_j(F_i) over the largest u",
               .expected = 0.0,
               .source = "Maxwell's reciprocity",
               .computed = reciprocity_error(bridge, pressed, components, 100.0)},
              1e-8, "round-off of displacements of 0.1 mm against 0.1 um that the forces add")}};
}

Findings unloading() {
  Findings findings;
  const Model wall = rough_wall();
  const Stage pressed{.load = side_pressure(wall, 4.0, kPressure)};
  const LoadTrace none = load_trace(wall, pressed, point_load(wall, NodeId{wall.mesh.node_count() - 2}, 1e3));
  findings.cases.push_back(
      absolute_case({.name = "Wall that does not slip, 1 kN on and off",
                     .quantity = "what is left over what the load did",
                     .expected = 0.0,
                     .source = "elasticity",
                     .computed = none.left / none.under_load},
                    1e-5, "Newton stops at 1e-8 of a node's share of the side pressure, 5 kN"));
  const Model bridge = make_model({});
  for (const std::size_t place : {std::size_t{9}, std::size_t{19}})
    for (const double force : {1e4, 1e5}) {
      const ControlPoint& point = bridge.control_points[place];
      const Field load = point_load(bridge, point.node, force);
      const LoadTrace once = load_trace(bridge, {}, load);
      const LoadTrace often = load_trace(bridge, {}, load, 8);
      Case remains = comparison(
          {.name = fmt::format("Reference bridge, {:.0f} kN on {} and off", 1e-3 * force, point.name),
           .quantity = "largest displacement left, in one step each [m]",
           .expected = often.left,
           .source = "in eight steps each",
           .computed = once.left},
          fmt::format("joints have slipped: {:.1f} % of the {:.2f} mm under the load remain",
                      100.0 * often.left / often.under_load, 1e3 * often.under_load));
      findings.cases.push_back(std::move(remains));
    }
  return findings;
}

}  // namespace

std::vector<Study> load_studies() {
  return {{.name = "load-column", .title = "Load on a column", .run = column_influence},
          {.name = "load-beam", .title = "Load on a beam of blocks", .run = beam_influence},
          {.name = "load-reciprocity", .title = "Reciprocity of loads", .run = reciprocity},
          {.name = "load-trace", .title = "Loading and unloading", .run = unloading}};
}

}  // namespace voussoir::validation
