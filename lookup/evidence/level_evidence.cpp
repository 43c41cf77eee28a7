#include "lookup/evidence/level_evidence.h"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>

#include "lookup/evidence/bounded_level_integral.h"
#include "lookup/evidence/largest_places.h"
#include "lookup/evidence/level_curve.h"
#include "lookup/evidence/row_blocks.h"
#include "lookup/evidence/scene_evidence.h"

namespace voussoir {
namespace {

constexpr double kCommonLevel = 0.05;  // from which the likeliest rows are looked for
constexpr std::size_t kLikely = 8;     // rows with which all levels are tried
constexpr int kLevelsPerOctave = 4;    // of the search for the likeliest level
constexpr double kPanel =
    3.0;  // widest panel of Gauss's rule, in the same deviations, and narrowest, in 1 / count
constexpr double kWidening = 1.4;  // of the steps below the peaks, where likelihoods level out

using LevelLogs = std::array<double, kMostShapes>;

/// Steps over a peak of deviation 1 / sqrt(power count).
struct GridRule {
  double step;  // in these deviations: the trapezoidal rule integrates a bell to 2 exp(-2 (pi / step)^2)
  double negligible;  // parts of an integrand below exp(-this) of its peak are left out
  double far;         // rows less likely than the best by exp(this) need not be exact
};
constexpr GridRule kFine = {1.1, 18.0, 30.0};
constexpr GridRule kCoarse = {1.3, 12.0, 20.0};

/// Logarithms of levels, ascending, with the weights of a rule of integration.
struct LevelGrid {
  std::vector<double> log_level, weight;
};

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

/// Integrals over the levels of rows under the same shapes.
class LevelIntegrals {
 public:
  /// `level` is where the best rows peak.
  LevelIntegrals(const Observation& observation, Shapes shapes, double level, const GridRule& rule)
      : count_(static_cast<double>(observation.count)),
        shapes_(shapes.size()),
        rule_(rule),
        peak_(std::log(level)),
        likelihood_(observation, shapes) {
    // Laplace's peaks are wider than Gaussian ones (LevelCurve::power), and Student's as long as nu is small.
    const double nu = observation.noise.degrees_of_freedom;
    const double power = shapes.front() == NoiseShape::laplace   ? 1.0
                         : shapes.front() == NoiseShape::student ? 2.0 * nu / (nu + 3.0)
                                                                 : 2.0;
    deviation_ = 1.0 / std::sqrt(power * count_);
    const double below = rule.far / count_ + std::sqrt(2.0 * rule.negligible / count_);
    const double above = below + (rule.negligible + 1.0) / count_;
    if (peak_ - below <= kLogSmallestLevel || peak_ + above >= kLogLargestLevel)
      whole_range_ = graded_panels(kLogSmallestLevel, kLogLargestLevel, count_);
  }

  /// For each shape log of the mean over all levels.
  LevelLogs of(std::span<const double> prediction) {
    likelihood_.take(prediction);
    LevelLogs logs = whole_range_.weight.empty() ? about_the_peak() : over_the_whole_range();
    for (double& log : logs) log -= std::log(log_range());
    return logs;
  }

 private:
  /// The likelihoods at a log level.
  struct Place {
    double log_level;
    LevelLogs logs;
  };

  Place at(double log_level) { return {log_level, likelihood_.at(std::exp(log_level))}; }

  bool is_negligible(const LevelLogs& logs, const LevelLogs& beside) const {
    for (std::size_t shape = 0; shape < shapes_; ++shape)
      if (logs[shape] > beside[shape] - rule_.negligible) return false;
    return true;
  }

  /// From the end towards small levels until nothing more is added.
  LevelLogs over_the_whole_range() {
    LevelLogs sums{kImpossible, kImpossible};
    for (std::size_t i = whole_range_.weight.size(); i-- > 0;) {
      LevelLogs terms = at(whole_range_.log_level[i]).logs;
      for (double& term : terms) term += std::log(whole_range_.weight[i]);
      if (is_negligible(terms, sums) && whole_range_.log_level[i] <= peak_) break;
      for (std::size_t shape = 0; shape < shapes_; ++shape) sums[shape] = log_sum(sums[shape], terms[shape]);
    }
    return sums;
  }

  /// By the trapezoidal rule in both directions from where the best rows peak, as far as anything is added.
  LevelLogs about_the_peak() {
    const double step = rule_.step * deviation_;
    std::vector<Place> places = {at(peak_)};
    LevelLogs top = places.front().logs;
    const auto add = [&](double log_level) {
      places.push_back(at(log_level));
      for (std::size_t shape = 0; shape < shapes_; ++shape)
        top[shape] = std::max(top[shape], places.back().logs[shape]);
      return !is_negligible(places.back().logs, top);
    };
    for (double above = peak_ + step; above < kLogLargestLevel && add(above);) above += step;
    std::reverse(places.begin(), places.end());
    const double likeliest =
        std::max_element(places.begin(), places.end(), [](const Place& a, const Place& b) {
          return a.logs.front() < b.logs.front();
        })->log_level;
    // Coarser beyond a peak's reach, where absolute errors and the model's make the level lose its meaning.
    const double reach = likeliest - std::sqrt(2.0 * rule_.negligible) * deviation_ - rule_.far / count_;
    double width = step;
    for (double below = peak_; below > kLogSmallestLevel;) {
      if (below < reach) width *= kWidening;
      below = std::max(kLogSmallestLevel, below - width);
      if (!add(below)) break;
    }
    return trapezoidal(places, top);
  }

  /// `places` in descending order.
  LevelLogs trapezoidal(const std::vector<Place>& places, const LevelLogs& top) const {
    LevelLogs sums{};
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double from = places[std::min(i + 1, places.size() - 1)].log_level,
                   to = places[i > 0 ? i - 1 : 0].log_level;
      for (std::size_t shape = 0; shape < shapes_; ++shape)
        sums[shape] += 0.5 * (to - from) * std::exp(places[i].logs[shape] - top[shape]);
    }
    LevelLogs logs{kImpossible, kImpossible};
    for (std::size_t shape = 0; shape < shapes_; ++shape)
      if (top[shape] > kImpossible) logs[shape] = top[shape] + std::log(sums[shape]);
    return logs;
  }

  double count_;
  std::size_t shapes_;
  GridRule rule_;
  double peak_;  // log level
  double deviation_ = 0.0;
  LevelGrid whole_range_;  // where a peak may reach beyond the levels' range
  RowLikelihood likelihood_;
};

}  // namespace

double likeliest_level(const Observation& observation, Shapes shapes, const SceneTable& table,
                       std::span<const std::size_t> rows) {
  double best = 0.5 * (kLogSmallestLevel + kLogLargestLevel);
  for (const double step : {std::log(2.0), std::log(2.0) / kLevelsPerOctave}) {
    const bool whole_range = step > 0.5;
    const double from = whole_range ? kLogSmallestLevel : std::max(kLogSmallestLevel, best - std::log(2.0));
    const double to = whole_range ? kLogLargestLevel : std::min(kLogLargestLevel, best + std::log(2.0));
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
  const bool is_fine = rule == LevelRule::fine;
  for_row_blocks_on_threads(rows, [&](std::span<const std::size_t> block) {
    const auto first = static_cast<std::size_t>(block.data() - rows.data());
    if (shapes.front() == NoiseShape::uniform) {
      RowLikelihood likelihood(observation, shapes);
      for (std::size_t i = 0; i < block.size(); ++i)
        results.front()[first + i] =
            log_bounded_integral(observation, table.row(block[i]), rule, likelihood) - std::log(log_range());
      return;
    }
    LevelIntegrals integrals(observation, shapes, level, is_fine ? kFine : kCoarse);
    for (std::size_t i = 0; i < block.size(); ++i) {
      const LevelLogs logs = integrals.of(table.row(block[i]));
      for (std::size_t shape = 0; shape < shapes.size(); ++shape) results[shape][first + i] = logs[shape];
    }
  });
  return results;
}

}  // namespace voussoir
