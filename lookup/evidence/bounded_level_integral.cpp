#include "lookup/evidence/bounded_level_integral.h"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <vector>

#include "lookup/evidence/level_curve.h"
#include "lookup/evidence/scene_evidence.h"
#include "lookup/readings/noise_model.h"

namespace voussoir {
namespace {

constexpr double kHardlyFelt = 4.0;  // deviations of the model inside of which a bound is hardly felt: 3e-5
constexpr double kMostScaleDeviations = 4.0;  // of an unknown common factor, that count
constexpr double kFarBeyond = 7.0;            // .. and beyond which a reading is all but excluded

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
  /// The likelihood, of uniform shape, outlives it and takes no other row meanwhile.
  BoundedRow(const Observation& observation, std::span<const double> prediction, RowLikelihood& likelihood)
      : observation_(observation), likelihood_(likelihood) {
    likelihood.take(prediction);
    find_edge(prediction);
  }

  /// The integral over all levels, from panels of levels in which it can matter.
  template <const PanelRule& kRule>
  double log_integral() {
    if (!is_possible_) return kImpossible;
    const double edge_end = std::clamp(std::log(end_), kLogSmallestLevel, kLogLargestLevel);
    // Where no level takes in all readings, those below the largest count as well.
    const double edge_begin = begin_ < kLargestLevel
                                  ? std::clamp(std::log(begin_), kLogSmallestLevel, kLogLargestLevel)
                                  : kLogSmallestLevel;
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
    for (double from = edge_end; from < kLogLargestLevel && last > top - kRule.negligible; step *= 2.0) {
      const double to = std::min(kLogLargestLevel, from + step);
      last = add(from, to).last;
      from = to;
    }
    return sum;
  }

 private:
  static constexpr double kPanelWidth = 6.0;

  /// Of log levels, in which the likelihood changes by exp(kPanelWidth) where all bounds hold.
  double width() const { return kPanelWidth / static_cast<double>(observation_.count); }

  double log_likelihood(double log_level) { return likelihood_.at(std::exp(log_level)).front(); }

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
  std::vector<Border> borders_between(double begin, double end, double negligible) {
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
  Panel panel_of(double from, double to) {
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
  void find_edge(std::span<const double> prediction) {
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
  RowLikelihood& likelihood_;
  bool is_possible_ = true;  // every reading has a prediction
  double begin_ = kSmallestLevel;
  double end_ = kSmallestLevel;
};

}  // namespace

double log_bounded_integral(const Observation& observation, std::span<const double> prediction,
                            LevelRule rule, RowLikelihood& likelihood) {
  BoundedRow row(observation, prediction, likelihood);
  return rule == LevelRule::fine ? row.log_integral<kFinePanels>() : row.log_integral<kCoarsePanels>();
}

}  // namespace voussoir
