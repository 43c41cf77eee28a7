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

/// How the integral of a bounded row is worked out.
struct PanelRule {
  std::size_t places;  // of Gauss's rule
  double negligible;   // what is below exp(-this) of the integrand's peak is left out
};
constexpr PanelRule kFinePanels = {7, 16.0};   // exp(6 t) to 3e-8 of its largest value
constexpr PanelRule kCoarsePanels = {5, 8.0};  // .. to 2e-5

/// One row under bounded errors: its integrand rises steeply where the bound takes in the last reading.
class BoundedRow {
 public:
  BoundedRow(const Observation& observation, const SceneTable& table, std::size_t row)
      : observation_(observation), table_(table), row_{row} {
    find_edge();
  }

  /// The integral over all levels, from panels of levels in which it can matter.
  template <const PanelRule& kRule>
  double log_integral() const {
    if (!is_possible_) return kImpossible;
    const double edge_end = std::clamp(std::log(end_), kLogSmallest, kLogLargest);
    // Where no level takes in all readings, those below the largest count as well.
    const double edge_begin =
        begin_ < kLargestLevel ? std::clamp(std::log(begin_), kLogSmallest, kLogLargest) : kLogSmallest;
    const std::vector<Border> borders = borders_between(edge_begin, edge_end, kRule.negligible);
    double top = std::max_element(borders.begin(), borders.end(), [](const Border& a, const Border& b) {
                   return a.log < b.log;
                 })->log;
    double sum = kImpossible;
    const auto add = [&](double from, double to) {
      const Panel panel = panel_of<kRule.places>(from, to);
      sum = log_sum(sum, panel.log_integral);
      top = std::max(top, panel.most);
      return panel;
    };
    for (std::size_t i = 1; i < borders.size(); ++i)
      if (most_below(borders[i - 1], borders[i].at) > top - kRule.negligible)
        add(borders[i].at, borders[i - 1].at);
    double last = borders.front().log;
    double step = width();
    for (double from = edge_end; from < kLogLargest && last > top - kRule.negligible; step *= 2.0) {
      const double to = std::min(kLogLargest, from + step);
      last = add(from, to).last;
      from = to;
    }
    return sum;
  }

 private:
  static constexpr double kPanelWidth = 6.0;

  /// Of log levels, in which the likelihood changes by exp(kPanelWidth) where all bounds hold.
  double width() const { return kPanelWidth / static_cast<double>(observation_.count); }

  double log_likelihood(double log_level) const {
    return log_likelihoods_at(observation_, kUniform, std::exp(log_level), table_, row_).front().front();
  }

  /// A log level and the likelihood's logarithm there.
  struct Border {
    double at, log;
  };

  /// The likelihood's logarithm between a border and a level below it at most: wider bounds take in no less,
  /// and make a reading within them less likely by their width alone.
  double most_below(const Border& border, double level) const {
    return border.log + static_cast<double>(observation_.count) * (border.at - level);
  }

  /// From the end down to the beginning, or to where the likelihood has become negligible; wider apart where
  /// it hardly changes.
  std::vector<Border> borders_between(double begin, double end, double negligible) const {
    std::vector<Border> borders = {{end, log_likelihood(end)}};
    double top = borders.front().log;
    for (double step = std::min(width(), end - begin); borders.back().at > begin && step > 0.0;) {
      const Border last = borders.back();
      const double at = std::max(begin, last.at - step);
      borders.push_back({at, log_likelihood(at)});
      const double log = borders.back().log;
      top = std::max(top, log);
      if (log < top - negligible) break;
      step = std::abs(log - last.log) < 1.0 ? 2.0 * step : std::min(2.0 * step, width());
    }
    return borders;
  }

  /// A part of the range of levels, the likelihood's logarithm at its last place and where it is largest.
  struct Panel {
    double log_integral = kImpossible, last = kImpossible, most = kImpossible;
  };

  template <std::size_t kPlaces>
  Panel panel_of(double from, double to) const {
    using Rule = boost::math::quadrature::gauss<double, kPlaces>;
    constexpr std::size_t kMiddle = kPlaces / 2;
    const double half = 0.5 * (to - from), middle = 0.5 * (to + from);
    std::array<double, kPlaces> logs{};
    Panel panel;
    for (std::size_t i = 0; i < kPlaces; ++i) {
      const double place = i < kMiddle ? -Rule::abscissa()[kMiddle - i] : Rule::abscissa()[i - kMiddle];
      logs.at(i) = log_likelihood(middle + half * place);
      panel.most = std::max(panel.most, logs.at(i));
    }
    panel.last = logs.back();
    if (panel.most == kImpossible) return panel;
    double sum = 0.0;
    for (std::size_t i = 0; i < kPlaces; ++i)
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

/// Of bounded errors, row by row.
std::vector<std::vector<double>> over_panels(const Observation& observation, const SceneTable& table,
                                             std::span<const std::size_t> rows, LevelRule rule) {
  std::vector<double> result;
  for (const std::size_t row : rows) {
    const BoundedRow bounded(observation, table, row);
    result.push_back((rule == LevelRule::fine ? bounded.log_integral<kFinePanels>()
                                              : bounded.log_integral<kCoarsePanels>()) -
                     std::log(log_range()));
  }
  return {std::move(result)};
}

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
  std::vector<std::vector<double>> results(shapes.size(), std::vector<double>(rows.size()));
  for_row_blocks_on_threads(rows, [&](std::span<const std::size_t> block) {
    const auto part = shapes.front() == NoiseShape::uniform
                          ? over_panels(observation, table, block, rule)
                          : over_grid(observation, shapes, level, table, block,
                                      rule == LevelRule::fine ? kFine : kCoarse);
    for (std::size_t shape = 0; shape < shapes.size(); ++shape)
      std::ranges::copy(part[shape], results[shape].begin() + (block.data() - rows.data()));
  });
  return results;
}

}  // namespace voussoir
