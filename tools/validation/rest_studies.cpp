/// @file Known answers of blocks at rest.

#include <fmt/format.h>

#include "core/statics/equilibrium.h"
#include "core/statics/quasi_static_solver.h"
#include "tools/validation/assemblies.h"
#include "tools/validation/bisection.h"
#include "tools/validation/studies.h"

namespace voussoir::validation {
namespace {

Findings stack() {
  Findings findings;
  constexpr int kCourses = 12;
  const Model bridge = column(kCourses, 1e16);
  const Field field = QuasiStaticSolver(bridge).solve(Scene{}).displacement;
  const double block = 0.5 * kSpecificWeight;
  double largest = 0.0;
  double settlement = 0.0;
  for (int below = 1; below < kCourses; ++below) {
    const double above = (kCourses - below) * block;
    const Point force = joint_force(bridge, field, BlockId{below}, BlockId{below - 1});
    largest = std::max(largest, (force - Point(0.0, -above)).norm() / above);
    settlement += above / bridge.parameters.contact.normal_stiffness;
  }
  const NodeId top = bridge.control_points.front().node;
  findings.cases = {
      absolute_case({.name = "Stack of 12 blocks",
                     .quantity = "force in a joint against the weight above, largest error, relative",
                     .expected = 0.0,
                     .source = "balance of forces, exact",
                     .computed = largest},
                    1e-6, "Newton stops at 1e-8 of the largest nodal load; a block has 5 nodes or more"),
      relative_case({.name = "Stack of 12 blocks",
                     .quantity = "settlement of the top [m]",
                     .expected = -settlement,
                     .source = "sum over the joints of weight above / p_n",
                     .computed = field(1, value(top))},
                    1e-5, "blocks of E = 1e16 Pa are 1e-7 as soft as the joints; strains of 1e-8")};
  return findings;
}

constexpr double kBlockWidth = 1.0;
constexpr double kHeight = 2.0;

/// A block of 1 m x 2 m on a clamped slab.
Model table(double normal_stiffness, double young_modulus) {
  BridgeDescription description;
  description.wall.length = 100.0;
  description.supports.sides = SupportKind::free;
  description.gravity = 0.0;
  description.material.young_modulus = young_modulus;
  description.joints = {.normal_stiffness = normal_stiffness,
                        .tangential_stiffness = normal_stiffness,
                        .friction_angle = std::atan(2.0)};
  return assemble_blocks(
      description, {rectangle({10.0, 0.0}, kBlockWidth, 0.5), rectangle({10.0, 0.5}, kBlockWidth, kHeight)});
}

/// The weight in a table that is tilted by an angle [rad].
Field tilted_weight(const Model& bridge, double angle) {
  Parameters with_gravity = bridge.parameters;
  with_gravity.gravity = 9.81;
  const Eigen::VectorXd weight = Coefficients(EquilibriumSystem(bridge), with_gravity).weight;
  return Point(std::sin(angle), -std::cos(angle)) * weight.transpose();
}

double topples_at(double normal_stiffness) {
  const Model bridge = table(normal_stiffness, 100.0 * normal_stiffness);
  return last_true(0.0, std::atan(1.0), 1e-6, [&](double angle) {
    const Stage tilted{.load = tilted_weight(bridge, angle)};
    return QuasiStaticSolver(bridge).solve(StageTask{.stage = tilted}).outcome == Outcome::standing;
  });
}

/// Angle [rad] at which a rigid block topples off an elastic joint without tension: the resultant N keeps a
/// third of the closed width a from the edge, and the block leans by 2 N / (p_n a^2); the best a.
double topples_on_elastic_joint(double normal_stiffness) {
  const double normal = kBlockWidth * kHeight * kSpecificWeight * std::cos(std::atan(kBlockWidth / kHeight));
  double best = 0.0;
  for (double a = kBlockWidth; a > 1e-5 * kBlockWidth; a *= 0.999)
    best = std::max(best, std::atan((0.5 * kBlockWidth - a / 3.0) / (0.5 * kHeight)) -
                              2.0 * normal / (normal_stiffness * a * a));
  return best;
}

Findings tilting_table() {
  Findings findings;
  const double rigid = std::atan(kBlockWidth / kHeight);
  Series computed{.label = "computed"};
  Series predicted{.label = "rigid block on an elastic joint"};
  for (const double stiffness : {1e8, 1e9, 1e10, 1e11, 1e12}) {
    const double angle = topples_at(stiffness);
    const double elastic = topples_on_elastic_joint(stiffness);
    findings.cases.push_back(relative_case(
        {.name = fmt::format("Block on a tilting table, p_n = {:.0e}", stiffness),
         .quantity = "tan of the angle at which it topples",
         .expected = std::tan(rigid),
         .source = "b / h, rigid block",
         .computed = std::tan(angle)},
        1.1 * (1.0 - std::tan(elastic) / std::tan(rigid)) + 1e-5,
        fmt::format("the elastic joint costs {:.2e}, in closed form; a tenth more for E = 100 p_n x 1 m",
                    1.0 - std::tan(elastic) / std::tan(rigid))));
    computed.points.emplace_back(stiffness, 1.0 - std::tan(angle) / std::tan(rigid));
    predicted.points.emplace_back(stiffness, 1.0 - std::tan(elastic) / std::tan(rigid));
  }
  findings.plots = {{.title = "Tilting table: what the joint's stiffness costs",
                     .x_label = "p_n [Pa/m]",
                     .y_label = "share of tan a = b/h that is lost",
                     .log_x = true,
                     .log_y = true,
                     .series = {computed, predicted}}};
  return findings;
}

}  // namespace

std::vector<Study> rest_studies() {
  return {{.name = "stack", .title = "Stack of blocks", .run = stack},
          {.name = "table", .title = "Block on a tilting table", .run = tilting_table}};
}

}  // namespace voussoir::validation
