#include "lookup/evidence/level_evidence.h"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>

#include "lookup/evidence/bounded_errors.h"
#include "lookup/evidence/largest_places.h"
#include "lookup/evidence/level_curve.h"
#include "lookup/evidence/row_blocks.h"
#include "lookup/evidence/scene_evidence.h"

namespace voussoir {
namespace {

constexpr double kNegligiblePart = 25.0;  // parts of an integrand below exp(-this) of its peak are left out
constexpr double kCommonLevel = 0.05;     // from which the likeliest rows are looked for
constexpr std::size_t kLikely = 8;        // rows with which all levels are tried
constexpr int kLevelsPerOctave = 4;       // of the search for the likeliest level
constexpr double kPanel =
    3.0;  // widest panel of Gauss's rule, in the same deviations, and narrowest, in 1 / count
constexpr double kWidening = 1.4;  // of the steps below the peaks, where likelihoods level out
constexpr double kBeyondEdges =
    16.0;  // a bounded row's likelihood below exp(-this) of its peak ends the integral
constexpr double kHardlyFelt = 4.0;  // deviations of the model inside of which a bound is hardly felt: 3e-5
constexpr double kMostScaleDeviations = 4.0;  // of an unknown common factor, that count
constexpr double kFarBeyond = 7.0;            // .. and beyond which a reading is all but excluded

constexpr std::array<NoiseShape, 1> kUniform = {NoiseShape::uniform};

const double kLogSmallest = std::log(kSmallestLevel);
const double kLogLargest = std::log(kLargestLevel);

/// A grid of levels about a peak of deviation 1 / sqrt(power count).
struct GridRule {
  double step;  // in these deviations: the trapezoidal rule integrates a bell to 2 exp(-2 (pi / step)^2)
  double negligible;  // parts of an integrand below exp(-this) of its peak are left out
  double far;         // rows less likely than the best by exp(this) need not be exact
};
constexpr GridRule kFine = {1.1, kNegligiblePart, 30.0};
constexpr GridRule kCoarse = {1.3, 12.0, 20.0};

/// Logarithms of levels, ascending, with the weights of a rule of integration.
struct LevelGrid {
  std::vector<double> log_level, weight;
};

/// The trapezoidal rule at these places.
LevelGrid trapezoidal(std::vector<double> places) {
  LevelGrid grid{std::move(places), {}};
  grid.weight.assign(grid.log_level.size(), 0.0);
  for (std::size_t i = 1; i < grid.log_level.size(); ++i) {
    const double half = 0.5 * (grid.log_level[i] - grid.log_level[i - 1]);
    grid.weight[i - 1] += half;
    grid.weight[i] += half;
  }
  return grid;
}

/// Gauss's rule in panels that are small at both ends, where the range of levels may cut a peak on its steep
/// side: likelihoods fall as fast as exp(-count u) there.
LevelGrid graded_panels(double first, double last, double count) {
  using Rule = boost::math::quadrature::gauss<double, 6>;
  const double most = kPanel / std::sqrt(2.0 * count);
  std::vector<double> lower = {first}, upper = {last};
  for (double width = kPanel / count; lower.back() < upper.back(); width = std::min(2.0 * width, most)) {
    const double gap = upper.back() - lower.back();
    if (gap <= 2.0 * width) break;
    lower.push_back(lower.back() + width);
    upper.push_back(upper.back() - width);
  }
  lower.insert(lower.end(), upper.rbegin(), upper.rend());
  LevelGrid grid;
  for (std::size_t i = 1; i < lower.size(); ++i) {
    const double half = 0.5 * (lower[i] - lower[i - 1]), middle = 0.5 * (lower[i] + lower[i - 1]);
    for (const int side : {-1, 1})
      for (std::size_t k = 0; k < Rule::abscissa().size(); ++k) {
        const std::size_t node = side < 0 ? Rule::abscissa().size() - 1 - k : k;
        grid.log_level.push_back(middle + side * half * Rule::abscissa()[node]);
        grid.weight.push_back(half * Rule::weights()[node]);
      }
  }
  return grid;
}

/// Fine about the level where the best rows peak, as far as rows that are not hopeless may peak and reach;
/// coarser below, where absolute errors and the model's make the level lose its meaning.
LevelGrid grid_about(double level, double count, double power, const GridRule& rule) {
  const double peak = std::log(level);
  const double step = rule.step / std::sqrt(power * count);
  const double reach = rule.far / count + std::sqrt(2.0 * rule.negligible / count);
  const double begin = peak - reach;
  const double end = peak + reach + (rule.negligible + 1.0) / count;
  if (begin <= kLogSmallest || end >= kLogLargest) return graded_panels(kLogSmallest, kLogLargest, count);
  std::vector<double> places;
  for (double below = begin, width = step; below > kLogSmallest; width *= kWidening) {
    below = std::max(kLogSmallest, below - width);
    places.push_back(below);
  }
  std::reverse(places.begin(), places.end());
  const int steps = std::max(1, static_cast<int>(std::ceil((end - begin) / step)));
  for (int i = 0; i <= steps; ++i) places.push_back(begin + (end - begin) * i / steps);
  return trapezoidal(std::move(places));
}

/// Sum over the grid, from its end towards small levels until nothing more is added.
std::vector<std::vector<double>> over_grid(const Observation& observation, Shapes shapes, double level,
                                           const SceneTable& table, std::span<const std::size_t> rows,
                                           const GridRule& rule) {
  // Laplace's peaks are wider than Gaussian ones (LevelCurve::power), and Student's as long as nu is small.
  const double nu = observation.noise.degrees_of_freedom;
  const double power = shapes.front() == NoiseShape::laplace   ? 1.0
                       : shapes.front() == NoiseShape::student ? 2.0 * nu / (nu + 3.0)
                                                               : 2.0;
  const LevelGrid grid = grid_about(level, static_cast<double>(observation.count), power, rule);
  std::vector<std::vector<double>> results(shapes.size(), std::vector<double>(rows.size(), kImpossible));
  for (std::size_t i = grid.weight.size(); i-- > 0;) {
    const auto logs = log_likelihoods_at(observation, shapes, std::exp(grid.log_level[i]), table, rows);
    const double log_weight = std::log(grid.weight[i]);
    bool adds = grid.log_level[i] > std::log(level);
    for (std::size_t shape = 0; shape < shapes.size(); ++shape)
      for (std::size_t row = 0; row < rows.size(); ++row) {
        double& sum = results[shape][row];
        const double term = logs[shape][row] + log_weight;
        adds |= term > sum - rule.negligible;
        sum = log_sum(sum, term);
      }
    if (!adds) break;
  }
  for (std::vector<double>& result : results)
    for (double& value : result) value -= std::log(log_range());
  return results;
}

/// One row under bounded errors: its integrand rises steeply where the bound takes in the last reading.
class BoundedRow {
 public:
  BoundedRow(const Observation& observation, const SceneTable& table, std::size_t row)
      : observation_(observation), table_(table), row_{row} {
    find_edge();
  }

  /// The integral over all levels.
  double log_integral() const {
    if (!is_possible_) return kImpossible;
    const double edge_end = std::clamp(std::log(end_), kLogSmallest, kLogLargest);
    // Where no level takes in all readings, those below the largest count as well.
    const double edge_begin =
        begin_ < kLargestLevel ? std::clamp(std::log(begin_), kLogSmallest, kLogLargest) : kLogSmallest;
    const double width = kPanelWidth / static_cast<double>(observation_.count);
    double sum = kImpossible;
    double top = kImpossible;
    // False once what lies beyond the far end adds nothing.
    const auto add = [&](const Panel& panel, double at_far_end) {
      sum = log_sum(sum, panel.log_integral);
      top = std::max(top, panel.most);
      return at_far_end > top - kBeyondEdges;
    };
    double step = width;
    for (double from = edge_end; from < kLogLargest; step *= 2.0) {
      const double to = std::min(kLogLargest, from + step);
      const Panel panel = panel_of(from, to);
      if (!add(panel, panel.last)) break;
      from = to;
    }
    step = std::min(width, edge_end - edge_begin);
    for (double to = edge_end; to > edge_begin && step > 0.0;) {
      const double from = std::max(edge_begin, to - step);
      const Panel panel = panel_of(from, to);
      if (!add(panel, panel.first)) break;
      to = from;
      step = panel.is_level() ? 2.0 * step : std::min(2.0 * step, width);
    }
    return sum;
  }

 private:
  static constexpr double kPanelWidth = 6.0;
  static constexpr std::size_t kPanelPlaces = 7;  // of Gauss's rule: exp(6 t) to 3e-8 of its largest value

  double log_likelihood(double log_level) const {
    return log_likelihoods_at(observation_, kUniform, std::exp(log_level), table_, row_).front().front();
  }

  /// A part of the range of levels, the likelihood's logarithm at its first and last place and where it is
  /// largest.
  struct Panel {
    double log_integral = kImpossible, first = kImpossible, last = kImpossible, most = kImpossible;

    /// The likelihood hardly changes: the next panel may be wider.
    bool is_level() const { return most - std::min(first, last) < 1.0; }
  };

  Panel panel_of(double from, double to) const {
    using Rule = boost::math::quadrature::gauss<double, kPanelPlaces>;
    constexpr std::size_t kMiddle = kPanelPlaces / 2;
    const double half = 0.5 * (to - from), middle = 0.5 * (to + from);
    std::array<double, kPanelPlaces> logs{};
    Panel panel;
    for (std::size_t i = 0; i < kPanelPlaces; ++i) {
      const double place = i < kMiddle ? -Rule::abscissa()[kMiddle - i] : Rule::abscissa()[i - kMiddle];
      logs.at(i) = log_likelihood(middle + half * place);
      panel.most = std::max(panel.most, logs.at(i));
    }
    panel.first = logs.front();
    panel.last = logs.back();
    if (panel.most == kImpossible) return panel;
    double sum = 0.0;
    for (std::size_t i = 0; i < kPanelPlaces; ++i)
      sum += Rule::weights()[i < kMiddle ? kMiddle - i : i - kMiddle] * std::exp(logs.at(i) - panel.most);
    panel.log_integral = panel.most + std::log(half * sum);
    return panel;
  }

  /// The levels between which the bound takes in the reading that needs the most.
  void find_edge() {
    const std::span<const double> prediction = table_.row(row_.front());
    const ErrorScales unit = scales_at(observation_, 1.0);
    const ExpectedErrors errors = expected_errors(observation_, unit, prediction);
    const double deviations = observation_.unknown_scale * kMostScaleDeviations;
    for (std::size_t i = 0; i < prediction.size(); ++i) {
      if (std::isnan(observation_.reading[i])) continue;
      is_possible_ = is_possible_ && !std::isnan(prediction[i]);
      if (unit.slope[i] == 0.0) continue;
      const double relative = errors.instrument[i] - observation_.floor[i];
      const double beyond = std::abs(observation_.reading[i] - prediction[i]) - observation_.floor[i];
      const double scaled = deviations * std::abs(prediction[i] - observation_.origin[i]);
      begin_ = std::max(
          begin_, (beyond - kFarBeyond * errors.model[i] - scaled) / relative * (1.0 - kBoundTolerance));
      end_ = std::max(end_,
                      (beyond + kHardlyFelt * errors.model[i] + scaled) / relative * (1.0 + kBoundTolerance));
    }
  }

  const Observation& observation_;
  const SceneTable& table_;
  std::array<std::size_t, 1> row_;
  bool is_possible_ = true;  // every reading has a prediction
  double begin_ = kSmallestLevel;
  double end_ = kSmallestLevel;
};

}  // namespace

double likeliest_level(const Observation& observation, Shapes shapes, const SceneTable& table,
                       std::span<const std::size_t> rows) {
  double best = 0.5 * (kLogSmallest + kLogLargest);
  for (const double step : {std::log(2.0), std::log(2.0) / kLevelsPerOctave}) {
    const bool whole_range = step > 0.5;
    const double from = whole_range ? kLogSmallest : std::max(kLogSmallest, best - std::log(2.0));
    const double to = whole_range ? kLogLargest : std::min(kLogLargest, best + std::log(2.0));
    const int steps = static_cast<int>(std::ceil((to - from) / step));
    double best_log = kImpossible;
    for (int i = 0; i <= steps; ++i) {
      const double log_level = from + (to - from) * i / steps;
      const auto logs = log_likelihoods_at(observation, shapes.first(1), std::exp(log_level), table, rows);
      for (const double log : logs.front())
        if (log > best_log) {
          best = log_level;
          best_log = log;
        }
    }
  }
  return std::exp(best);
}

double likeliest_level_of_all(const Observation& observation, Shapes shapes, const SceneTable& table,
                              std::span<const std::size_t> rows) {
  std::vector<std::size_t> likely =
      largest_places(estimated_peaks(observation, shapes, kCommonLevel, table, rows), kLikely);
  for (std::size_t& place : likely) place = rows[place];
  return likeliest_level(observation, shapes, table, likely);
}

double log_width(NoiseShape shape, std::size_t count) {
  const auto n = static_cast<double>(count);
  if (shape == NoiseShape::uniform) return -std::log(n * log_range());
  const double power = shape == NoiseShape::gaussian ? 2.0 : 1.0;
  return 0.5 * std::log(2.0 * std::numbers::pi / (n * power)) - std::log(log_range());
}

std::vector<std::vector<double>> evidence_over_levels(const Observation& observation, Shapes shapes,
                                                      double level, const SceneTable& table,
                                                      std::span<const std::size_t> rows, LevelRule rule) {
  std::vector<std::vector<double>> results(shapes.size());
  if (shapes.front() == NoiseShape::uniform) {
    for (const std::size_t row : rows)
      results.front().push_back(BoundedRow(observation, table, row).log_integral() - std::log(log_range()));
    return results;
  }
  for (const auto block : row_blocks(rows)) {
    const auto part =
        over_grid(observation, shapes, level, table, block, rule == LevelRule::fine ? kFine : kCoarse);
    for (std::size_t shape = 0; shape < shapes.size(); ++shape)
      results[shape].insert(results[shape].end(), part[shape].begin(), part[shape].end());
  }
  return results;
}

}  // namespace voussoir
