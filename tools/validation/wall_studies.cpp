/// @file Dry-stone shear walls: a comparison with tests.

#include <fmt/format.h>

#include "core/statics/quasi_static_solver.h"
#include "tools/validation/assemblies.h"
#include "tools/validation/studies.h"

namespace voussoir::validation {
namespace {

constexpr double kWallWidth = 1.0;      ///< [m] of the wall; it is as high
constexpr double kWallThickness = 0.2;  ///< [m]
constexpr double kBlock = 0.2;          ///< [m] long, half as high
constexpr double kLeft = 10.0;          ///< [m] x of the left side, away from the supports of bridges
constexpr double kFooting = 0.1;        ///< [m]
constexpr int kCourses = 10;

/// Ten courses in running bond between a clamped footing and a beam.
Model shear_wall(double friction) {
  BridgeDescription description;
  description.wall.length = 100.0;
  description.supports.sides = SupportKind::free;
  description.material = {
      .young_modulus = 15.5e9, .poisson_ratio = 0.2, .density = 2400.0, .thickness = kWallThickness};
  description.joints = {
      .normal_stiffness = 5e9, .tangential_stiffness = 2e9, .friction_angle = std::atan(friction)};
  std::vector<Polygon> blocks = {rectangle({kLeft, 0.0}, kWallWidth, kFooting)};
  for (int course = 0; course < kCourses; ++course) {
    const double y = kFooting + 0.5 * kBlock * course;
    std::vector<double> x = {0.0};
    for (double at = course % 2 == 0 ? kBlock : 0.5 * kBlock; at < kWallWidth - 1e-9; at += kBlock)
      x.push_back(at);
    x.push_back(kWallWidth);
    for (std::size_t i = 0; i + 1 < x.size(); ++i)
      blocks.push_back(rectangle({kLeft + x[i], y}, x[i + 1] - x[i], 0.5 * kBlock));
  }
  blocks.push_back(rectangle({kLeft, kFooting + kWallWidth}, kWallWidth, 0.1));
  return assemble_blocks(description, blocks);
}

/// Both forces spread evenly along the beam's top [N].
Field load_on_beam(const Model& bridge, double vertical, double horizontal) {
  Field load = Field::Zero(2, bridge.mesh.node_count());
  const double top = kFooting + kWallWidth + 0.1;
  for (const BoundaryEdge& edge : bridge.mesh.edges) {
    const Point from = bridge.mesh.position(edge.from);
    const Point to = bridge.mesh.position(edge.to);
    if (std::min(from.y(), to.y()) < top - 1e-9) continue;
    const double share = 0.5 * (to - from).norm() / kWallWidth;
    for (const NodeId node : {edge.from, edge.to})
      load.col(value(node)) += share * Point(horizontal, -vertical);
  }
  return load;
}

/// Force against displacement of the beam, up to the greatest force that stands.
struct Response {
  double greatest = 0.0;  ///< [N]
  Series curve;           ///< displacement [mm], force [kN]
};

/// Every scrap of patience: close to the peak blocks come loose and stick again in many combinations.
QuasiStaticSettings patient_newton() {
  QuasiStaticSettings settings;
  settings.skips.early_outcome = false;
  settings.follow_falls = false;
  settings.most_warm_iterations = 100;
  settings.most_iterations = 100;
  return settings;
}

/// The force grows by steps that are halved when nothing stands, until they are a two-thousandth of the
/// vertical force.
Response push(double friction, double vertical) {
  const Model bridge = shear_wall(friction);
  const NodeId corner{bridge.mesh.block_nodes.back().end - 1};
  QuasiStaticSolver solver(bridge, patient_newton());
  Response response;
  Field start;
  double step = 0.02 * vertical;
  while (step > 5e-4 * vertical && response.greatest < vertical) {
    const double force = start.size() > 0 ? response.greatest + step : 0.0;
    const Stage pushed{.load = load_on_beam(bridge, vertical, force)};
    const Solution solution = solver.solve({.stage = pushed, .start = start.size() > 0 ? &start : nullptr});
    if (solution.outcome == Outcome::standing) {
      start = solution.displacement;
      response.greatest = force;
      response.curve.points.emplace_back(1e3 * start(0, value(corner)), 1e-3 * force);
    } else {
      step *= 0.5;
    }
  }
  return response;
}

/// Two walls under one stress.
struct Tested {
  double stress;                 ///< [Pa]
  std::vector<double> greatest;  ///< [kN]
};

void push_walls(const Tested& tested, Findings& findings) {
  const double vertical = tested.stress * kWallWidth * kWallThickness;
  const double measured = 0.5 * (tested.greatest[0] + tested.greatest[1]);
  Plot plot{.title = fmt::format("Dry-stone wall under {:.2f} MPa", tested.stress * 1e-6),
            .x_label = "displacement of the top [mm]",
            .y_label = "horizontal force [kN]"};
  double furthest = 0.0;
  for (const double friction : {0.55, 0.60, 0.65, 0.70}) {
    Response response = push(friction, vertical);
    response.curve.label = fmt::format("tan phi = {:.2f}", friction);
    furthest = std::max(furthest, response.curve.points.back().first);
    plot.series.push_back(response.curve);
    findings.cases.push_back(comparison(
        {.name =
             fmt::format("Dry-stone wall under {:.2f} MPa, tan phi = {:.2f}", tested.stress * 1e-6, friction),
         .quantity = "greatest horizontal force [kN]",
         .expected = measured,
         .source = fmt::format("Lourenco et al. 2005, two walls: {} and {}", tested.greatest[0],
                               tested.greatest[1]),
         .computed = 1e-3 * response.greatest},
        "joint data of the walls are uncertain (here p_n = 5e9, p_t = 2e9 Pa/m); the beam is "
        "free to turn"));
  }
  for (const double peak : tested.greatest)
    plot.series.push_back(
        {.label = fmt::format("measured peak {} kN", peak), .points = {{0.0, peak}, {furthest, peak}}});
  findings.plots.push_back(plot);
}

Findings shear_walls() {
  Findings findings;
  for (const Tested& tested : {Tested{0.15e6, {21.9, 22.9}}, Tested{0.50e6, {41.5, 48.2}}})
    push_walls(tested, findings);
  findings.notes = {
      "The beam on the walls is free to turn. Rocking about the toe then bounds the force by V b / 2h and "
      "the weight's share, "
      "16 kN under 0.15 MPa, whatever the friction: the walls that took 22 kN cannot have been so free.",
      "Newton's joints keep no history, and the force grows by steps until nothing stands: the curves end at "
      "the peak."};
  return findings;
}

}  // namespace

std::vector<Study> wall_studies() {
  return {{.name = "walls", .title = "Dry-stone shear walls", .quick = false, .run = shear_walls}};
}

}  // namespace voussoir::validation
