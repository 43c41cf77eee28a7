#include "lookup/answer/expected_readings.h"

#include <cmath>

#include "core/not_a_number.h"
#include "lookup/readings/shown_readings.h"

namespace voussoir {

std::vector<double> expected_readings(const Answer& answer, const Comparison& comparison) {
  const std::vector<double> origin = origin_of(comparison);
  const std::vector<double> stated = shown_readings(comparison, answer.candidates.front().row).expected;
  std::vector<double> expected = answer.known_bridge ? stated : std::vector<double>(stated.size(), kNan);
  for (const SensorResidual& sensor : answer.residuals)  // of a point that cannot move the scene says all
    expected[sensor.point] =
        std::isnan(sensor.error) ? stated[sensor.point] : sensor.predicted - origin[sensor.point];
  return expected;
}

}  // namespace voussoir
