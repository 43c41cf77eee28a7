#include "lookup/checks/fewer_readings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/not_a_number.h"
#include "core/text.h"
#include "lookup/answer/verdict.h"

namespace voussoir {
namespace {

constexpr std::size_t kMostDisagreeing = 2;

}  // namespace

Comparison without_readings(Comparison comparison, std::span<const std::size_t> channels) {
  for (const std::size_t channel : channels) {
    comparison.measured.displacement[channel] = comparison.measured.sigma[channel] = kNan;
    comparison.measured.silent[channel] = false;
    if (!comparison.before.empty()) comparison.before[channel] = comparison.after[channel] = kNan;
  }
  return comparison;
}

std::vector<std::size_t> channels_at(const Comparison& comparison, std::string_view names) {
  const Measurements& measured = comparison.measured;
  std::vector<std::size_t> channels;
  for (const std::string_view name : split(names, ',')) {
    const std::size_t before = channels.size();
    for (std::size_t i = 0; i < comparison.library.points.size(); ++i)
      if (name_without_load(comparison, i) == name &&
          (measured.silent[i] || !std::isnan(measured.displacement[i])))
        channels.push_back(i);
    if (channels.size() == before)
      throw InputError(
          fmt::format("--without: {} has no row in the file, expected names of points or sensors "
                      "that have",
                      in_quotes(name)));
  }
  return channels;
}

std::vector<std::vector<std::size_t>> suspects_among(const std::vector<SensorResidual>& residuals) {
  const std::vector<SensorResidual> odd = disagreeing(residuals);
  std::vector<std::vector<std::size_t>> suspects;
  for (const SensorResidual& sensor : std::span(odd).first(std::min(odd.size(), kMostDisagreeing)))
    suspects.push_back({sensor.point});
  return suspects;
}

std::vector<std::vector<std::size_t>> suspects_of(const Answer& answer) {
  if (!answer.posterior || !answer.fit) return {};
  const Verdict verdict = verdict_by_probability(*answer.posterior, answer.fit->explained);
  const bool is_open = verdict == Verdict::unexplained || verdict == Verdict::cannot_tell;
  return is_open ? answer.fit->suspects : std::vector<std::vector<std::size_t>>();
}

bool are_sensors_judged(const Answer& answer) {
  const bool falls = answer.known_bridge && answer.candidates.front().outcome == Outcome::collapsed;
  return !falls && !answer.without;
}

std::vector<SensorResidual> told_residuals(const Answer& answer) {
  std::vector<SensorResidual> told = answer.residuals;
  if (told.empty() || are_sensors_judged(answer)) return told;
  const auto decides = [&](std::size_t point) {
    return answer.without &&
           std::ranges::find(answer.without->channels, point) != answer.without->channels.end();
  };
  for (SensorResidual& sensor : told) sensor.disagrees = sensor.disagrees && decides(sensor.point);
  return told;
}

}  // namespace voussoir
