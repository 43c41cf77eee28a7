#include "lookup/report/pictured_answer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/median.h"
#include "core/structure/exposed_edges.h"
#include "core/units.h"
#include "lookup/answer/expected_readings.h"
#include "lookup/answer/verdict.h"
#include "lookup/report/drawing/table.h"

namespace voussoir {
namespace {

std::string epochs_in_words(const PicturedAnswer& report, std::size_t point) {
  if (report.comparison.before.empty()) return "";
  return fmt::format("before {}, after {}\n",
                     fixed_decimals(kMillimetres * report.comparison.before[point], report.decimals),
                     fixed_decimals(kMillimetres * report.comparison.after[point], report.decimals));
}

/// So many that half the error at most sensors can be seen, and at least those of a micrometre.
int decimals_of(const std::vector<SensorResidual>& residuals) {
  constexpr int kFewest = 3, kMost = 7;
  std::vector<double> errors;
  for (const SensorResidual& residual : residuals)
    if (residual.scale > 0.0) errors.push_back(kMillimetres * residual.scale);
  if (errors.empty()) return kFewest;
  return std::clamp(static_cast<int>(-std::floor(std::log10(0.5 * median(errors)))), kFewest, kMost);
}

bool is_on_upper_face(const Point& place, const Block& block) {
  const auto [left, right] = upper_face(block);
  const Point along = right - left;
  const double length = along.squaredNorm();
  const double part = length > 0.0 ? std::clamp((place - left).dot(along) / length, 0.0, 1.0) : 0.0;
  return (place - (left + part * along)).norm() <= kPointTolerance;
}

}  // namespace

PicturedAnswer::PicturedAnswer(const Answer& of, const Comparison& with)
    : answer(of),
      comparison(with),
      library(with.library),
      shown(shown_readings(with, of.candidates.front().row)),
      expected(expected_readings(of, with)),
      residual(with.library.points.size(), nullptr),
      open_losses(of.posterior ? voussoir::open_losses(of) : std::vector<OpenLoss>{}),
      decimals(decimals_of(of.residuals)) {
  for (const SensorResidual& one : of.residuals) residual[one.point] = &one;
}

Site site_of(const PicturedAnswer& report, std::size_t point) {
  const StoredPoint& at = report.library.points[point];
  const Block& block = report.library.layout[at.block];
  if (block.role == BlockRole::ring) return Site::arch;
  const bool is_height = quantity_of(report.comparison, point) == Quantity::uy;
  return is_height && block.top_course && is_on_upper_face(at.position, block) ? Site::top : Site::elsewhere;
}

const SensorResidual* residual_of(const PicturedAnswer& report, std::size_t point) {
  return report.residual[point];
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
  return fmt::format("{}\n{}{} {} {}\nexpected {} {}{}", name, epochs_in_words(report, point),
                     reading_word(report), fixed_decimals(kMillimetres * reading, report.decimals), unit,
                     fixed_decimals(kMillimetres * expected, report.decimals), unit,
                     disagrees(report, point) ? "\ndisagrees with the rest" : "");
}

}  // namespace voussoir
