/// @file Known answers of the triangles.

#include <Eigen/Geometry>
#include <limits>

#include "core/bridge_file/bridge_file.h"
#include "core/statics/equilibrium.h"
#include "core/statics/quasi_static_solver.h"
#include "tools/validation/assemblies.h"
#include "tools/validation/studies.h"

namespace voussoir::validation {
namespace {

Vector6d corner_displacements(const Triangle& triangle, const Field& field) {
  Vector6d q;
  for (int i = 0; i < 3; ++i)
    q.segment<2>(2 * i) = field.col(value(triangle.nodes[static_cast<std::size_t>(i)]));
  return q;
}

/// Stresses (xx, yy, xy) of all triangles [Pa], one a column.
Eigen::Matrix3Xd stresses(const Model& bridge, const Field& field) {
  const Mesh& mesh = bridge.mesh;
  Eigen::Matrix3Xd result(3, static_cast<Eigen::Index>(mesh.triangles.size()));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& n = mesh.triangles[t].nodes;
    const TriangleShape shape = triangle_shape(mesh.position(n[0]), mesh.position(n[1]), mesh.position(n[2]));
    result.col(static_cast<Eigen::Index>(t)) =
        triangle_stress(shape, plane_moduli(bridge.parameters.blocks.front()),
                        corner_displacements(mesh.triangles[t], field));
  }
  return result;
}

/// Mean displacement of the horizontal boundary at height y, weighted by length.
Point mean_at_height(const Model& bridge, const Field& field, double y) {
  Point sum = Point::Zero();
  double length = 0.0;
  for (const BoundaryEdge& edge : bridge.mesh.edges) {
    const Point from = bridge.mesh.position(edge.from);
    const Point to = bridge.mesh.position(edge.to);
    if (std::abs(from.y() - y) > 1e-9 || std::abs(to.y() - y) > 1e-9) continue;
    const double part = (to - from).norm();
    sum += 0.5 * part * (field.col(value(edge.from)) + field.col(value(edge.to)));
    length += part;
  }
  return sum / length;
}

/// A plate of 2 m x 1 m with irregular triangles on rollers at the left and below.
Model plate() {
  BridgeDescription description;
  description.wall.length = 100.0;
  description.supports = {.base = SupportKind::roller, .sides = SupportKind::roller};
  description.gravity = 0.0;
  description.mesh.refinement = 3;
  Model bridge = assemble_blocks(description, {rectangle(Point::Zero(), 2.0, 1.0)});
  disturb_inner_nodes(0.125, 0.3, bridge);
  return bridge;
}

Case solved_patch() {
  const Model bridge = plate();
  const Field load = boundary_tractions(bridge, {1e3, -2e3, 0.0});
  const Solution solution = QuasiStaticSolver(bridge).solve(StageTask{.stage = {.load = load}});
  const Eigen::Matrix3Xd s = stresses(bridge, solution.displacement);
  const double spread = (s.colwise() - Eigen::Vector3d(1e3, -2e3, 0.0)).cwiseAbs().maxCoeff() / 2e3;
  return absolute_case({.name = "CST patch test, irregular mesh of 128 triangles, solved",
                        .quantity = "largest departure from the constant stress, relative",
                        .expected = 0.0,
                        .source = "exact",
                        .computed = spread},
                       1e-6,
                       "strains of 1e-7 make the stress differ by as much from Hooke's law; Newton 1e-8");
}

Case imposed_patch() {
  const Model bridge = plate();
  Eigen::Matrix2d gradient;
  gradient << 2e-7, 3e-7, -1e-7, -4e-7;
  const Field field = gradient * bridge.mesh.nodes;
  const EquilibriumSystem system(bridge);
  const Coefficients coefficients(system, bridge.parameters);
  const Field forces = unbalanced_forces(StageEquations(system, coefficients, Stage{}), field);
  std::vector<bool> inside(static_cast<std::size_t>(bridge.mesh.node_count()), true);
  for (const BoundaryEdge& edge : bridge.mesh.edges)
    inside[static_cast<std::size_t>(value(edge.from))] = false;
  double largest = 0.0;
  for (int node = 0; node < bridge.mesh.node_count(); ++node)
    if (inside[static_cast<std::size_t>(node)]) largest = std::max(largest, forces.col(node).norm());
  return absolute_case({.name = "CST patch test, linear field imposed",
                        .quantity = "largest force on an inner node over the largest force",
                        .expected = 0.0,
                        .source = "exact",
                        .computed = largest / forces.colwise().norm().maxCoeff()},
                       1e-13, "round-off: displacements carry 16 digits, six triangles meet at a node");
}

Findings patch_test() {
  return {.cases = {imposed_patch(), solved_patch()}};
}

/// A bar of 1 m x 4 m in one block.
Model bar(const SupportDescription& supports, double length, double poisson_ratio, PlaneState plane) {
  BridgeDescription description;
  description.wall.length = length;
  description.supports = supports;
  description.material.poisson_ratio = poisson_ratio;
  description.material.plane = plane;
  description.mesh.refinement = 2;
  return assemble_blocks(description, {rectangle(Point::Zero(), 1.0, 4.0)});
}

constexpr double kBarHeight = 4.0;

double top_of(const Model& bridge, const Field& load = {}) {
  const Solution solution = QuasiStaticSolver(bridge).solve(StageTask{.stage = {.load = load}});
  return mean_at_height(bridge, solution.displacement, kBarHeight).y();
}

double self_weight(const Model& bridge) {
  return bridge.parameters.blocks.front().density * bridge.parameters.gravity;
}

Case pulled_bar() {
  Model bridge =
      bar({.base = SupportKind::roller, .sides = SupportKind::roller}, 100.0, 0.2, PlaneState::stress);
  bridge.parameters.gravity = 0.0;
  const double stress = 1e4;
  return relative_case({.name = "Bar under an end load",
                        .quantity = "displacement of the end [m]",
                        .expected = stress * kBarHeight / bridge.parameters.blocks.front().young_modulus,
                        .source = "sigma H / E, exact",
                        .computed = top_of(bridge, boundary_tractions(bridge, {0.0, stress, 0.0}))},
                       1e-6, "strain 4e-7: large-displacement strain differs from the linear one by as much");
}

Case hanging_weight(const std::string& name, const Model& bridge, double modulus, const std::string& source) {
  return relative_case({.name = name,
                        .quantity = "mean displacement of the top [m]",
                        .expected = -self_weight(bridge) * kBarHeight * kBarHeight / (2.0 * modulus),
                        .source = source,
                        .computed = top_of(bridge)},
                       1e-5, "strain 4e-6: large-displacement strain differs from the linear one by as much");
}

Findings bars() {
  Findings findings;
  const double e = Material{}.young_modulus;
  const Model free_sides =
      bar({.base = SupportKind::clamped, .sides = SupportKind::free}, 1.0, 0.0, PlaneState::stress);
  const SupportDescription box{.base = SupportKind::clamped, .sides = SupportKind::roller};
  const Model confined = bar(box, 1.0, 0.2, PlaneState::stress);
  const Model confined_strain = bar(box, 1.0, 0.2, PlaneState::strain);
  findings.cases = {
      pulled_bar(),
      hanging_weight("Column under its own weight", free_sides, e, "rho g H^2 / 2E, exact at the nodes"),
      hanging_weight("Column between smooth walls, plane stress", confined, e / (1.0 - 0.04),
                     "modulus E / (1 - nu^2), exact"),
      hanging_weight("Column between smooth walls, plane strain", confined_strain, e * 0.8 / (1.2 * 0.6),
                     "modulus E (1 - nu) / ((1 + nu) (1 - 2 nu)), exact")};
  return findings;
}

constexpr double kBeamLength = 10.0;  ///< [m], 1 m deep

/// Deflection of the tip [m] of a beam that sags under its own weight.
double tip_deflection(int refinement) {
  BridgeDescription description;
  description.wall.length = 1000.0;
  description.supports = {.base = SupportKind::free, .sides = SupportKind::clamped};
  description.material.young_modulus = 1e12;
  description.material.poisson_ratio = 0.0;
  description.mesh.refinement = refinement;
  const Model bridge = assemble_blocks(description, {strip(kBeamLength, 1.0, 10)});
  const Field field = QuasiStaticSolver(bridge).solve(Scene{}).displacement;
  double sum = 0.0;
  for (int node = 0; node < bridge.mesh.node_count(); ++node) {
    const Point x = bridge.mesh.nodes.col(node);
    const bool corner = x.x() > kBeamLength - 1e-9 && std::min(x.y(), 1.0 - x.y()) < 1e-9;
    if (corner) sum -= 0.5 * field(1, node);
  }
  return sum;
}

Findings cantilever() {
  Findings findings;
  std::vector<double> tips;
  constexpr int kLevels = 6;
  for (int level = 0; level < kLevels; ++level) tips.push_back(tip_deflection(level));
  const double before = tips[kLevels - 2] - tips[kLevels - 3];
  const double last = tips[kLevels - 1] - tips[kLevels - 2];
  const double converged = tips.back() + last / 3.0;  // Richardson, order 2
  const double load = kSpecificWeight;
  const double bending = load * std::pow(kBeamLength, 4) * 12.0 / (8.0 * 1e12);
  const double shear = 1.2 * load * kBeamLength * kBeamLength / (2.0 * 0.5e12);
  findings.cases = {
      absolute_case({.name = "Cantilever under its own weight, 6 meshes, 20 to 20,480 triangles",
                     .quantity = "order of convergence of the tip's deflection",
                     .expected = 2.0,
                     .source = "linear triangles: energy converges with the square of their size",
                     .computed = std::log2(before / last)},
                    0.15, "the next term of the error is of order 3 or 4: 1/16 to 1/8 of the leading one"),
      relative_case({.name = "Cantilever under its own weight, extrapolated",
                     .quantity = "deflection of the tip [m]",
                     .expected = bending + shear,
                     .source = "Timoshenko's beam, w L^4 / 8EI + 1.2 w L^2 / 2GA",
                     .computed = converged},
                    0.0025, "beam theory leaves out the clamped end: a share of (depth / length)^2 = 1 %")};
  Series error{.label = "error against the extrapolated deflection"};
  for (int level = 0; level < kLevels; ++level)
    error.points.emplace_back(std::pow(0.5, level),
                              std::abs(tips[static_cast<std::size_t>(level)] / converged - 1.0));
  findings.plots = {{.title = "Cantilever: error against the size of the triangles",
                     .x_label = "edge of the triangles [m]",
                     .y_label = "relative error of the deflection",
                     .log_x = true,
                     .log_y = true,
                     .series = {error}}};
  return findings;
}

Findings rigid_rotation() {
  const Model bridge = make_model(reference_bridge_file().description);
  double largest = 0.0;
  for (const double angle : {1e-6, 1e-3, 0.1, 1.0, 2.0, 3.0}) {
    const Eigen::Matrix2d turn = Eigen::Rotation2Dd(angle).toRotationMatrix();
    const Field field = turn * bridge.mesh.nodes - bridge.mesh.nodes;
    largest = std::max(largest, stresses(bridge, field).cwiseAbs().maxCoeff());
  }
  double shortest = std::numeric_limits<double>::infinity();
  for (const BoundaryEdge& edge : bridge.mesh.edges)
    shortest = std::min(shortest, (bridge.mesh.position(edge.to) - bridge.mesh.position(edge.from)).norm());
  const double round_off =
      std::numeric_limits<double>::epsilon() * bridge.mesh.nodes.row(0).maxCoeff() / shortest;
  Findings findings;
  findings.cases = {absolute_case(
      {.name = "Rigid rotation of the reference bridge, 1e-6 to 3 rad",
       .quantity = "largest stress over E",
       .expected = 0.0,
       .source = "exact",
       .computed = largest / bridge.parameters.blocks.front().young_modulus},
      16.0 * round_off,
      "round-off of places 20 m from the origin over the shortest edge, eight operations of two terms")};
  return findings;
}

}  // namespace

std::vector<Study> elasticity_studies() {
  return {{.name = "patch", .title = "Patch test of the triangles", .run = patch_test},
          {.name = "bars", .title = "Bars and columns", .run = bars},
          {.name = "cantilever", .title = "Cantilever", .run = cantilever},
          {.name = "rotation", .title = "Rigid rotation", .run = rigid_rotation}};
}

}  // namespace voussoir::validation
