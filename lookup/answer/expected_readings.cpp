#include "lookup/answer/expected_readings.h"

#include <cmath>

#include "core/not_a_number.h"
#include "lookup/readings/shown_readings.h"

namespace voussoir {

/// Of a held point nothing is known but that.
std::vector<double> expected_readings(const Answer& answer, const Comparison& comparison) {
  const std::vector<double> origin = origin_of(comparison);
  const std::vector<double> stated = shown_readings(comparison, answer.candidates.front().row).expected;
  std::vector<double> expected = answer.known_bridge ? stated : std::vector<double>(stated.size(), kNan);
  for (const SensorResidual& sensor : answer.residuals)
    expected[sensor.point] =
        std::isnan(sensor.error) ? stated[sensor.point] : sensor.predicted - origin[sensor.point];
  return expected;
}

}  // namespace voussoir
