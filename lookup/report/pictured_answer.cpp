#include "lookup/report/pictured_answer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "lookup/answer/expected_readings.h"

namespace voussoir {
namespace {

std::string epochs_in_words(const PicturedAnswer& report, std::size_t point) {
  if (report.comparison.before.empty()) return "";
  return fmt::format("before {:.4g}, after {:.4g}\n", kMillimetres * report.comparison.before[point],
                     kMillimetres * report.comparison.after[point]);
}

}  // namespace

PicturedAnswer::PicturedAnswer(const Answer& of, const Comparison& with)
    : answer(of),
      comparison(with),
      library(with.library),
      shown(shown_readings(with, of.candidates.front().row)),
      expected(expected_readings(of, with)) {}

Site site_of(const PicturedAnswer& report, std::size_t point) {
  const auto& points = report.library.points;
  if (report.library.layout[points[point].block].role == BlockRole::ring) return Site::arch;
  if (report.library.storage == nullptr)
    return report.library.layout[points[point].block].top_course ? Site::top : Site::elsewhere;
  const auto lower = [](const StoredPoint& a, const StoredPoint& b) {
    return a.position.y() < b.position.y();
  };
  const double highest = std::max_element(points.begin(), points.end(), lower)->position.y();
  return points[point].position.y() >= highest - kPointTolerance ? Site::top : Site::elsewhere;
}

const SensorResidual* residual_of(const PicturedAnswer& report, std::size_t point) {
  const auto& residuals = report.answer.residuals;
  const auto found = std::find_if(residuals.begin(), residuals.end(),
                                  [&](const SensorResidual& residual) { return residual.point == point; });
  return found == residuals.end() ? nullptr : &*found;
}

bool disagrees(const PicturedAnswer& report, std::size_t point) {
  const SensorResidual* const residual = residual_of(report, point);
  return residual != nullptr && residual->disagrees;
}

std::string_view reading_word(const PicturedAnswer& report) {
  return is_change(report.comparison.kind) ? "change" : "reading";
}

std::string point_tip(const PicturedAnswer& report, std::size_t point) {
  const std::string& name = report.library.points[point].name;
  const double reading = report.shown.reading[point];
  const double expected = report.expected[point];
  const std::string_view unit = unit_of(quantity_of(report.comparison, point));
  if (std::isnan(reading))
    return fmt::format("{}\n{}", name, report.comparison.measured.silent[point] ? "no reading" : "no sensor");
  return fmt::format("{}\n{}{} {:.4g} {}\nexpected {:.4g} {}{}", name, epochs_in_words(report, point),
                     reading_word(report), kMillimetres * reading, unit, kMillimetres * expected, unit,
                     disagrees(report, point) ? "\ndisagrees with the rest" : "");
}

}  // namespace voussoir
