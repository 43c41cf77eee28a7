#include "tools/benchmarks/growth.h"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/statics/quasi_static_solver.h"
#include "lookup/report/drawing/chart.h"
#include "tools/benchmarks/default_build.h"
#include "tools/benchmarks/timing.h"

namespace voussoir {
namespace {

/// Scenes of a viaduct: enough that how many of them take twenty linear systems is not left to chance.
constexpr int kViaductScenes = 96;

double megabytes_in_use() {
  const struct mallinfo2 info = mallinfo2();
  return 1e-6 * static_cast<double>(info.uordblks + info.hblkhd);
}

/// Singles, evenly spread over the blocks; 0: all.
std::vector<Scene> spread_singles(const Model& model, int count, bool only_wall) {
  std::vector<Scene> singles;
  for (int block = 0; block < model.block_count(); ++block)
    if (!only_wall || model.layout[BlockId{block}].role == BlockRole::wall)
      singles.push_back({{BlockId{block}}});
  std::vector<Scene> chosen;
  const std::size_t wanted =
      count == 0 ? singles.size() : std::min(singles.size(), static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < wanted; ++i)
    chosen.push_back(singles[(2 * i + 1) * singles.size() / (2 * wanted)]);
  return chosen;
}

/// Newton alone, singles from the intact field.
class Equilibria {
 public:
  Equilibria(const BridgeDescription&, const Model& model) : solver_(model) {}
  void solve_intact() { intact_ = solver_.solve(Scene{}).displacement; }
  std::vector<Solution> solve(std::span<const Scene> scenes) {
    std::vector<StageTask> tasks;
    for (const Scene& scene : scenes) tasks.push_back({.stage = {.scene = scene}, .start = &intact_});
    return solver_.solve(tasks);
  }

 private:
  QuasiStaticSolver solver_;
  Field intact_;
};

template <class Solver>
GrowthPoint measure(double x, const BridgeDescription& bridge, const Model& model,
                    const std::vector<Scene>& singles) {
  const double before = megabytes_in_use();
  Solver solver(bridge, model);
  GrowthPoint point{.x = x, .blocks = model.block_count(), .megabytes = megabytes_in_use() - before};
  solver.solve_intact();
  const double begin = processor_seconds();
  const std::vector<Solution> solutions = solver.solve(singles);
  point.seconds = (processor_seconds() - begin) / static_cast<double>(singles.size());
  for (const Solution& solution : solutions)
    (solution.outcome == Outcome::standing    ? point.standing
     : solution.outcome == Outcome::collapsed ? point.collapsed
                                              : point.unresolved) += 1;
  return point;
}

double smallest_piece(const BridgeDescription& description) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Block& block : make_model(description).layout.blocks)
    smallest = std::min(smallest, area(block.polygon));
  return smallest;
}

std::vector<double> decades(int first, int last) {
  std::vector<double> values;
  for (int exponent = first; exponent <= last; ++exponent) values.push_back(std::pow(10.0, exponent));
  return values;
}

template <class Value>
std::vector<double> column(const Growth& growth, Value GrowthPoint::*member) {
  std::vector<double> values;
  for (const GrowthPoint& point : growth.points) values.push_back(static_cast<double>(point.*member));
  return values;
}

/// Such an exponent only says how the measurements scatter.
bool is_flat(double exponent) {
  return std::abs(exponent) < 0.05;
}

}  // namespace

double fitted_exponent(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double u = std::log(x[i]);
    const double v = std::log(y[i]);
    sx += u, sy += v, sxx += u * u, sxy += u * v;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

BridgeDescription viaduct(int spans) {
  BridgeDescription bridge;
  const SpanDescription span = bridge.spans.front();
  const double pitch = 2.0 * span.extrados_radius() + 2.0;
  bridge.name = fmt::format("{} spans", spans);
  bridge.wall.length += pitch * (spans - 1);
  bridge.spans.clear();
  for (int i = 0; i < spans; ++i) {
    bridge.spans.push_back(span);
    bridge.spans.back().centre_x += pitch * i;
  }
  return bridge;
}

BridgeDescription with_smallest_piece(double wanted) {
  constexpr int kHeights = 200;
  constexpr double kLowest = 0.8, kHighest = 1.05;  // [m] of the springings
  BridgeDescription best;
  double least = std::numeric_limits<double>::infinity();
  const auto consider = [&](double centre) {
    BridgeDescription bridge;
    for (SpanDescription& span : bridge.spans) span.centre_y = centre;
    const double off = std::abs(std::log(smallest_piece(bridge) / wanted));
    if (off >= least) return;
    least = off;
    best = bridge;
  };
  for (int i = 0; i <= kHeights; ++i) consider(kLowest + (kHighest - kLowest) * i / kHeights);
  for (double step = (kHighest - kLowest) / kHeights / 2.0; step > 1e-7; step *= 0.5) {
    const double centre = best.spans.front().centre_y;
    consider(centre - step);
    consider(centre + step);
  }
  return best;
}

std::vector<Growth> measure_growth(int most_spans, int scenes,
                                   const std::function<void(const Growth&)>& progress) {
  std::vector<Growth> all = {
      {"blocks", "blocks", {}}, {"stiffness", "p_n [Pa/m]", {}}, {"piece", "smallest piece [m2]", {}}};
  const auto add = [&](Growth& growth, GrowthPoint point) {
    growth.points.push_back(point);
    progress(growth);
  };
  for (int spans = 1; spans <= most_spans; spans *= 2) {
    const BridgeDescription bridge = viaduct(spans);
    const Model model = make_model(bridge);
    add(all[0],
        measure<Equilibria>(model.block_count(), bridge, model, spread_singles(model, kViaductScenes, true)));
  }
  for (const double stiffness : decades(7, 12)) {
    BridgeDescription bridge;
    bridge.joints.normal_stiffness = stiffness;
    bridge.joints.tangential_stiffness = 0.1 * stiffness;
    const Model model = make_model(bridge);
    add(all[1], measure<DefaultBuild>(stiffness, bridge, model, spread_singles(model, scenes, false)));
  }
  for (const double piece : decades(-6, -1)) {
    const BridgeDescription bridge = with_smallest_piece(piece);
    const Model model = make_model(bridge);
    add(all[2],
        measure<DefaultBuild>(smallest_piece(bridge), bridge, model, spread_singles(model, scenes, false)));
  }
  return all;
}

std::string to_markdown(const Growth& growth) {
  std::string text = fmt::format(
      "| {} | blocks | standing | collapsed | unresolved | ms a scene | times the first | MB a solver |\n"
      "|---|---|---|---|---|---|---|---|\n",
      growth.unit);
  for (const GrowthPoint& point : growth.points)
    text += fmt::format("| {:.3g} | {} | {} | {} | {} | {:.2f} | {:.2f} | {:.1f} |\n", point.x, point.blocks,
                        point.standing, point.collapsed, point.unresolved, 1e3 * point.seconds,
                        point.seconds / growth.points.front().seconds, point.megabytes);
  const std::vector<double> x = column(growth, &GrowthPoint::x);
  const auto exponent = [&](double GrowthPoint::*member) {
    const double fitted = fitted_exponent(x, column(growth, member));
    return is_flat(fitted) ? "none (flat)" : fmt::format("{:.2f}", fitted);
  };
  return text + fmt::format("\nFitted exponents: time {}, memory {}\n\n", exponent(&GrowthPoint::seconds),
                            exponent(&GrowthPoint::megabytes));
}

std::string to_svg(const Growth& growth) {
  const std::vector<double> x = column(growth, &GrowthPoint::x);
  const auto series = [&](const char* what, int colour, double unit, double GrowthPoint::*member) {
    std::vector<double> y = column(growth, member);
    const double exponent = fitted_exponent(x, y);
    for (double& value : y) value *= unit;
    const std::string power = is_flat(exponent) ? "" : fmt::format(", exponent {:.2f}", exponent);
    return Series{what + power, colour, Mark::beads, x, y};
  };
  Chart chart{fmt::format("Time and memory of a scene over {}", growth.unit),
              {growth.unit, AxisScale::logarithmic},
              {"ms a scene, MB a solver", AxisScale::logarithmic},
              {series("processor time a scene [ms]", 1, 1e3, &GrowthPoint::seconds),
               series("memory of a solver [MB]", 2, 1.0, &GrowthPoint::megabytes)}};
  chart.width = 640.0;
  chart.height = 400.0;
  return svg_file(draw_with_legend(chart));
}

}  // namespace voussoir
