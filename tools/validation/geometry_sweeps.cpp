/// @file Hard cases: slivers, gaps, sizes, directions, offsets.

#include <fmt/format.h>
#include <numbers>
#include <random>

#include "core/statics/quasi_static_solver.h"
#include "tools/validation/assemblies.h"
#include "tools/validation/bisection.h"
#include "tools/validation/hard_case_runs.h"
#include "tools/validation/studies.h"

namespace voussoir::validation {
namespace {

double smallest_area(const BlockLayout& layout) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Block& block : layout.blocks) smallest = std::min(smallest, area(block.polygon));
  return smallest;
}

/// The small bridge with a ring so thick that its extrados leaves a piece of just this area [m2] of a wall
/// block.
BridgeDescription with_sliver(double sliver) {
  BridgeDescription description = small_bridge();
  description.wall.smallest_piece = 1e-12;
  const auto layout = [&](double thickness) {
    description.spans.front().ring_thickness = thickness;
    return lay_blocks(description);
  };
  // Thicker rings cut more away: a piece shrinks until it is gone.
  constexpr double kStep = 1e-3;
  double thin = description.spans.front().ring_thickness;
  std::size_t blocks = layout(thin).size();
  for (std::size_t next = layout(thin + kStep).size(); next >= blocks; next = layout(thin + kStep).size()) {
    blocks = next;
    thin += kStep;
  }
  const double gone =
      last_true(thin, thin + kStep, 1e-15, [&](double t) { return layout(t).size() >= blocks; });
  description.spans.front().ring_thickness = last_true(
      thin - 50.0 * kStep, gone, 1e-15, [&](double t) { return smallest_area(layout(t)) > sliver; });
  return description;
}

Findings slivers() {
  Findings findings;
  for (const double sliver : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
    const Model bridge = make_model(with_sliver(sliver));
    run_setting({.sweep = "sliver",
                 .value = fmt::format("{:.1e} m2", smallest_area(bridge.layout)),
                 .bridge = bridge,
                 .scenes = usual_scenes()},
                1e-4, nullptr, findings);
  }
  return findings;
}

/// Every block but those on supports moved by up to a quarter of `gap` [m] each way, so that neighbours come
/// to lie up to half of it apart or in each other.
Model with_gaps(double gap) {
  Model bridge = make_model(small_bridge());
  std::mt19937 random(5);
  std::uniform_real_distribution<double> way(-0.25 * gap, 0.25 * gap);
  const double right = bridge.mesh.nodes.row(0).maxCoeff();
  for (const IndexRange& range : bridge.mesh.block_nodes) {
    auto nodes = bridge.mesh.nodes.middleCols(range.begin, range.size());
    Point shift(way(random), way(random));
    if (nodes.row(0).minCoeff() < 1e-9 || nodes.row(0).maxCoeff() > right - 1e-9) shift.x() = 0.0;
    if (nodes.row(1).minCoeff() < 1e-9) shift.y() = 0.0;
    nodes.colwise() += shift;
  }
  bridge.joints = find_joints(bridge.mesh, small_bridge().joint_tolerance + 2.0 * gap);
  bridge.parameters.joints.resize(bridge.joints.size(), bridge.parameters.contact);
  bridge.symmetry.reset();
  return bridge;
}

Findings gaps() {
  Findings findings;
  const std::vector<Expectation> scenes = {{"intact", Outcome::standing, "the exact bridge stands"},
                                           {"4,2", Outcome::standing, "the exact bridge stands"}};
  const Signals exact = tightest_signals(make_model(small_bridge()), scenes);
  Series error{.label = "signal of (4,2)"};
  for (const double gap : {1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3}) {
    // Joints open or press by p_n times the gap: the answer itself changes, by the gap over the bridge's sag
    // of 0.5 mm.
    run_setting({.sweep = "gaps, overlaps",
                 .value = fmt::format("{:.0e} m", gap),
                 .bridge = with_gaps(gap),
                 .scenes = scenes},
                std::max(1e-4, gap / 5e-4), &exact, findings);
    if (const auto e = findings.hard_cases.back().error) error.points.emplace_back(gap, *e);
  }
  findings.notes = {
      fmt::format("Gaps and overlaps in the geometry open or press joints by p_n times the gap. They change "
                  "the signal by {:.0f} times "
                  "the gap in metres at p_n = 1e9 Pa/m: to 1e-5 m they hardly matter, with 1e-3 m the signal "
                  "means nothing.",
                  error.points[3].second / error.points[3].first)};
  findings.plots = {{.title = "Gaps and overlaps of joints in the input: what they change",
                     .x_label = "twice the largest gap or overlap [m]",
                     .y_label = "error of the signal against the exact bridge",
                     .log_x = true,
                     .log_y = true,
                     .series = {error}}};
  return findings;
}

Model shifted(Model bridge, double distance) {
  bridge.mesh.nodes.row(0).array() += distance;
  for (Block& block : bridge.layout.blocks)
    for (Point& corner : block.polygon) corner.x() += distance;
  bridge.joints = find_joints(bridge.mesh, small_bridge().joint_tolerance);
  bridge.parameters.joints.resize(bridge.joints.size(), bridge.parameters.contact);
  bridge.symmetry.reset();
  return bridge;
}

Findings offsets() {
  Findings findings;
  std::vector<Expectation> scenes = usual_scenes();
  for (Expectation& e : scenes) e.because += ", 10 m from the origin";
  const Model bridge = make_model(small_bridge());
  const Signals near = tightest_signals(shifted(bridge, 10.0), scenes);
  for (const double distance : {10.0, 1e3, 1e4, 1e5, 1e6})
    // Places carry 16 digits: at 1e6 m they are right to 1e-10 m, where the sag is 5e-4 m and the signal 1e-5
    // m or more.
    run_setting({.sweep = "offset",
                 .value = fmt::format("{:.0e} m", distance),
                 .bridge = shifted(bridge, distance),
                 .scenes = scenes},
                std::max(1e-4, 10.0 * distance * 2.2e-16 / 1e-5), &near, findings);
  return findings;
}

/// Walls of very long, very short and thin blocks.
Findings sizes() {
  Findings findings;
  struct Size {
    double length;
    double height;
    int courses;
  };
  for (const Size& size :
       {Size{6.0, 0.5, 5}, Size{3.0, 0.5, 5}, Size{0.1, 0.5, 5}, Size{1.0, 0.1, 25}, Size{1.0, 2.5, 1}}) {
    BridgeDescription description = small_bridge();
    description.wall.block_length = size.length;
    description.wall.course_height = size.height;
    description.wall.courses = size.courses;
    run_setting({.sweep = "block size",
                 .value = fmt::format("{:g} m x {:g} m", size.length, size.height),
                 .bridge = make_model(description),
                 .scenes = {{"intact", Outcome::standing, "the usual blocks stand"},
                            {"0,5", Outcome::collapsed, "an arch without a voussoir"}}},
                1e-4, nullptr, findings);
  }
  return findings;
}

/// Blocks of 1 m and plates of `thin` m in turn on a clamped one: joints give way by the weight above over
/// p_n, blocks by their mean force over E.
HardCase uneven_stack(double thin) {
  constexpr int kPairs = 4;
  BridgeDescription description;
  description.wall.length = 100.0;
  description.supports.sides = SupportKind::free;
  description.material.poisson_ratio = 0.0;
  std::vector<Polygon> blocks = {rectangle({50.0, 0.0}, 1.0, 1.0)};
  constexpr double weight = kSpecificWeight;
  double top = 1.0;
  double settlement =
      weight * (kPairs * (1.0 + thin) + 0.5) / description.material.young_modulus;  // the lowest block
  for (int i = 0; i < kPairs; ++i) {
    const double above = (kPairs - i) * (1.0 + thin);
    const double below_block = above - thin;
    settlement += weight * (above + below_block) / description.joints.normal_stiffness;
    settlement += weight * ((above - 0.5 * thin) * thin + (below_block - 0.5) * 1.0) /
                  description.material.young_modulus;
    blocks.push_back(rectangle({50.0, top}, 1.0, thin));
    blocks.push_back(rectangle({50.0, top + thin}, 1.0, 1.0));
    top += 1.0 + thin;
  }
  const Model bridge = assemble_blocks(description, blocks);
  const Solution solution = QuasiStaticSolver(bridge).solve(Scene{});
  const int top_right = bridge.mesh.block_nodes.back().begin + 2;
  const double computed =
      -0.5 * (solution.displacement(1, top_right) + solution.displacement(1, top_right + 1));
  HardCase row{.sweep = "stack of uneven blocks",
               .setting = fmt::format("1 m and {:g} m", thin),
               .scene = "column",
               .verdict = std::string(to_string(solution.outcome)),
               .expected = "standing, with the settlement of the closed form within 1e-4",
               .error = std::abs(computed / settlement - 1.0),
               .iterations = solution.iterations};
  row.correct = solution.outcome == Outcome::standing && *row.error < 1e-4;
  return row;
}

/// A block that sticks on a slope: the joint carries its weight, and nothing else.
HardCase at_angle(const std::string& name, double slope) {
  const Model bridge = block_on_wedge(slope, std::atan(2.0));
  const Solution solution = QuasiStaticSolver(bridge).solve(Scene{});
  const double weight = 0.5 * kSpecificWeight;
  HardCase row{.sweep = "direction of a joint",
               .setting = name,
               .scene = "wedge",
               .verdict = std::string(to_string(solution.outcome)),
               .expected = "standing, with the block's weight in the joint within 1e-6",
               .iterations = solution.iterations};
  row.error =
      (joint_force(bridge, solution.displacement, BlockId{0}, BlockId{1}) - Point(0.0, weight)).norm() /
      weight;
  row.correct = solution.outcome == Outcome::standing && *row.error < 1e-6;
  return row;
}

Findings uneven_and_turned() {
  Findings findings = sizes();
  for (const double thin : {0.1, 1e-2, 1e-3, 1e-4}) findings.hard_cases.push_back(uneven_stack(thin));
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  for (const auto& [name, slope] :
       std::vector<std::pair<std::string, double>>{{"1e-6", 1e-6},
                                                   {"1e-3", 1e-3},
                                                   {"1 / pi", std::numbers::inv_pi},
                                                   {"golden ratio", golden},
                                                   {"atan(1 / sqrt 2)", std::atan(std::sqrt(0.5))},
                                                   {"45 deg", 0.25 * std::numbers::pi},
                                                   {"pi / sqrt 12", std::numbers::pi / std::sqrt(12.0)}})
    findings.hard_cases.push_back(at_angle(name, slope));
  return findings;
}

}  // namespace

std::vector<Study> geometry_sweeps() {
  return {{.name = "sweep-slivers", .title = "Slivers", .quick = false, .run = slivers},
          {.name = "sweep-gaps", .title = "Gaps and overlaps in the input", .run = gaps},
          {.name = "sweep-offset", .title = "Bridges far from the origin", .run = offsets},
          {.name = "sweep-shapes",
           .title = "Uneven blocks, turned joints",
           .quick = false,
           .run = uneven_and_turned}};
}

}  // namespace voussoir::validation
