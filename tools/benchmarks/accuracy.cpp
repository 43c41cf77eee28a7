#include "tools/benchmarks/accuracy.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "core/error.h"
#include "core/motion/dynamic_solver.h"
#include "core/statics/quasi_static_solver.h"
#include "lookup/report/drawing/chart.h"
#include "tools/benchmarks/timing.h"

namespace voussoir {
namespace {

constexpr const char* kDefaultMesh = "split edges";

/// Readings [m] of intact and of every scene, and what they cost.
struct Readings {
  std::vector<Eigen::VectorXd> of_scene;  ///< intact first
  double seconds = 0.0;                   ///< a scene
};

std::vector<Scene> with_intact(const AccuracyOptions& options, const Model& bridge) {
  std::vector<Scene> scenes = {{}};
  for (const std::string& text : options.scenes) scenes.push_back(parse_scene(text, bridge.layout));
  return scenes;
}

Readings quasi_static_readings(const Model& bridge, const std::vector<Scene>& scenes,
                               const QuasiStaticSettings& settings, bool from_intact) {
  QuasiStaticSolver solver(bridge, settings);
  Readings readings;
  const Field intact = solver.solve(scenes.front()).displacement;
  std::vector<StageTask> starts;
  for (const Scene& scene : scenes)
    starts.push_back({.stage = {.scene = scene}, .start = from_intact ? &intact : nullptr});
  const double begin = processor_seconds();
  const std::vector<Solution> solutions = solver.solve(starts);
  readings.seconds = (processor_seconds() - begin) / static_cast<double>(scenes.size());
  for (const Solution& solution : solutions)
    readings.of_scene.push_back(readings_at(bridge.control_points, solution.displacement));
  return readings;
}

Readings dynamic_readings(const Model& bridge, const std::vector<Scene>& scenes,
                          const DynamicSettings& settings) {
  DynamicSolver solver(bridge, settings);
  Readings readings;
  const double begin = processor_seconds();
  const std::vector<DynamicSolution> solutions = solver.solve(scenes);
  readings.seconds = (processor_seconds() - begin) / static_cast<double>(scenes.size());
  for (const DynamicSolution& solution : solutions)
    readings.of_scene.push_back(readings_at(bridge.control_points, solution.solution.displacement));
  return readings;
}

void compare(const Readings& readings, const Readings& reference, AccuracyRow& row) {
  double distance = 0.0;
  double size = 0.0;
  for (std::size_t scene = 1; scene < readings.of_scene.size(); ++scene)
    for (Eigen::Index i = 0; i < readings.of_scene[scene].size(); ++i) {
      const double expected = reference.of_scene[scene][i] - reference.of_scene[0][i];
      const double found = readings.of_scene[scene][i] - readings.of_scene[0][i];
      if (std::isnan(expected) || std::isnan(found)) continue;
      distance += std::abs(found - expected);
      size += std::abs(expected);
      row.largest_error =
          std::max(row.largest_error, std::abs(readings.of_scene[scene][i] - reference.of_scene[scene][i]));
    }
  row.signal_error = distance / size;
  row.seconds = readings.seconds;
}

Model refined_bridge(BridgeDescription description, int level) {
  description.mesh.refinement = level;
  return make_model(description);
}

/// Measures rows of one bridge against the reference.
class Bench {
 public:
  Bench(const BridgeDescription& description, const AccuracyOptions& options)
      : description_(description),
        bridge_(make_model(description)),
        options_(options),
        scenes_(with_intact(options, bridge_)) {
    const Model fine = refined_bridge(description, options.reference_refinement);
    reference_ = quasi_static_readings(fine, scenes_, {}, false);
    for (const Eigen::VectorXd& d : reference_.of_scene)
      if (!d.array().isNaN().select(0.0, d).allFinite())
        throw Failure("a scene of the reference does not stand");
    add({.solver = "quasi-static",
         .integrator = "-",
         .step = "1e-08",
         .joints = "exact",
         .ramp = "-",
         .mesh = fmt::format("refined {}x", options.reference_refinement),
         .variation = "reference"},
        reference_);
  }

  void quasi_static(const QuasiStaticSettings& settings, bool from_intact, const std::string& variation) {
    add({.solver = "quasi-static",
         .integrator = "-",
         .step = fmt::format("{:.0e}", settings.tolerance),
         .joints = std::string(to_string(settings.joint_rule)),
         .ramp = "-",
         .mesh = kDefaultMesh,
         .variation = variation,
         .is_default = variation.empty()},
        quasi_static_readings(bridge_, scenes_, settings, from_intact));
  }

  /// The default solver on another mesh.
  void mesh(const MeshDescription& mesh, const std::string& name) {
    BridgeDescription description = description_;
    description.mesh = mesh;
    add({.solver = "quasi-static",
         .integrator = "-",
         .step = "1e-08",
         .joints = "exact",
         .ramp = "-",
         .mesh = name,
         .variation = ""},
        quasi_static_readings(make_model(description), scenes_, {}, true));
  }

  void dynamic(double ramp, std::optional<double> step, double unbalance, int side_by_side) {
    DynamicSettings settings;
    settings.ramp = settings.moment = ramp;
    settings.decision.earliest_decision = ramp + 0.1;
    settings.decision.latest_decision = ramp + 1.0;
    settings.step = step;
    settings.decision.standing_unbalance = unbalance;
    settings.side_by_side = side_by_side;
    add({.solver = "dynamic",
         .integrator = "implicit blocks",
         .step = fmt::format("{}, {:.0e}", step ? fmt::format("{:.1e} s", *step) : "0.9 critical", unbalance),
         .joints = "exact",
         .ramp = fmt::format("{} s", ramp),
         .mesh = kDefaultMesh,
         .variation = side_by_side == 1 ? "one scene at a time" : ""},
        dynamic_readings(bridge_, scenes_, settings));
  }

  /// The first scene only: it takes minutes.
  void plain() {
    DynamicSettings settings;
    settings.integrator = Integrator::central_differences;
    const std::vector<Scene> two = {scenes_[0], scenes_[1]};
    add({.solver = "dynamic",
         .integrator = "central differences",
         .step = "0.9 critical",
         .joints = "exact",
         .ramp = "0.3 s",
         .mesh = kDefaultMesh,
         .variation = "first scene only"},
        dynamic_readings(bridge_, two, settings));
  }

  std::vector<AccuracyRow> rows() const { return rows_; }

 private:
  void add(AccuracyRow row, const Readings& readings) {
    compare(readings, reference_, row);
    rows_.push_back(row);
  }

  BridgeDescription description_;
  Model bridge_;
  AccuracyOptions options_;
  std::vector<Scene> scenes_;
  Readings reference_;
  std::vector<AccuracyRow> rows_;
};

constexpr double kShortestTime = 1e-6;  // [s] the clock's resolution
constexpr double kMostPerCent = 100.0;

/// One colour's points of the plot.
Series series_of(const std::vector<AccuracyRow>& rows, const std::string& name, int colour,
                 const std::function<bool(const AccuracyRow&)>& belongs) {
  Series series{name, colour, Mark::points, {}, {}};
  for (const AccuracyRow& row : rows) {
    if (row.signal_error <= 0.0 || !belongs(row)) continue;  // the reference itself has no error
    series.x.push_back(std::max(row.seconds, kShortestTime));
    series.y.push_back(kMostPerCent * row.signal_error);
    series.notes.push_back(fmt::format("{} {} {}", row.step, row.ramp, row.variation));
  }
  return series;
}

}  // namespace

std::vector<AccuracyRow> measure_accuracy(const BridgeDescription& description,
                                          const AccuracyOptions& options) {
  Bench bench(description, options);
  bench.quasi_static({}, true, "");
  bench.quasi_static({}, false, "no warm start");
  QuasiStaticSettings loose;
  loose.tolerance = 1e-5;
  bench.quasi_static(loose, true, "loose tolerance");
  for (const JointRule rule : {JointRule::gauss_16, JointRule::lobatto_3}) {
    QuasiStaticSettings by_points;
    by_points.joint_rule = rule;
    bench.quasi_static(by_points, true, "points in joints");
  }
  bench.mesh({.split_at_corners = false}, "whole edges");
  bench.mesh({.refinement = 1}, "refined 1x");
  for (const double ramp : {0.1, 0.3, 1.0, 3.0}) bench.dynamic(ramp, std::nullopt, 1e-6, 4);
  for (const double unbalance : {2.3e-4, 1e-8}) bench.dynamic(0.3, std::nullopt, unbalance, 4);
  bench.dynamic(0.3, 1e-4, 1e-6, 4);
  bench.dynamic(0.3, std::nullopt, 1e-6, 1);
  if (options.plain) bench.plain();
  return bench.rows();
}

std::string to_markdown(const std::vector<AccuracyRow>& rows) {
  std::string text =
      "| solver | integrator | step, tolerance | joint integration | ramp | mesh | variation | s a scene | "
      "signal error | "
      "largest error [um] |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n";
  for (const AccuracyRow& row : rows)
    text += fmt::format("| {} | {} | {} | {} | {} | {} | {}{} | {:.4f} | {:.2f} % | {:.2f} |\n", row.solver,
                        row.integrator, row.step, row.joints, row.ramp, row.mesh, row.variation,
                        row.is_default ? "**default**" : "", row.seconds, 100.0 * row.signal_error,
                        1e6 * row.largest_error);
  return text;
}

std::string to_svg(const std::vector<AccuracyRow>& rows) {
  Chart chart{"Error of the solvers' signal over their run time",
              {"processor time a scene [s]", AxisScale::logarithmic},
              {"error of the signal [%]", AxisScale::logarithmic},
              {}};
  chart.width = 800.0;
  chart.height = 500.0;
  const auto dynamic = [](const AccuracyRow& row) { return row.solver == "dynamic"; };
  chart.series = {series_of(rows, "dynamic", 1, dynamic),
                  series_of(rows, "quasi-static", 3,
                            [&](const AccuracyRow& row) { return !dynamic(row) && !row.is_default; }),
                  series_of(rows, "default", 2, [](const AccuracyRow& row) { return row.is_default; })};
  return svg_file(draw_with_legend(chart));
}

}  // namespace voussoir
