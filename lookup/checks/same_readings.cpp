#include "lookup/checks/same_readings.h"

#include <algorithm>
#include <cmath>

namespace voussoir {
namespace {

/// Scenes whose predictions differ by less than this, as the root of the sum of squares in units of sigma,
/// are one scene to these sensors: even a hundred repeated measurements would hardly tell them apart.
constexpr double kSameReadings = 0.1;
constexpr double kSolverPrecision = 1e-9;  // [m] predictions are not compared more closely

/// Of each reading if a prediction is the truth; zero where there is no reading.
std::vector<double> inverse_errors(const Observation& observation, const ErrorScales& scales,
                                   std::span<const double> prediction) {
  const ExpectedErrors expected = expected_errors(observation, scales, prediction);
  std::vector<double> result(prediction.size(), 0.0);
  for (std::size_t i = 0; i < prediction.size(); ++i)
    if (!std::isnan(observation.reading[i]))
      result[i] = 1.0 / std::max(std::hypot(expected.instrument[i], expected.model[i]), kSolverPrecision);
  return result;
}

bool are_same(std::span<const double> one, std::span<const double> other,
              const std::vector<double>& inverse) {
  double sum = 0.0;
  for (std::size_t i = 0; i < other.size(); ++i) {
    if (inverse[i] == 0.0) continue;
    const double difference = (one[i] - other[i]) * inverse[i];
    sum += difference * difference;
    if (sum > kSameReadings * kSameReadings) return false;
  }
  return !std::isnan(sum);
}

}  // namespace

std::vector<std::size_t> same_readings(const Observation& observation, const ErrorScales& scales,
                                       const SceneTable& table, std::size_t row,
                                       std::span<const std::size_t> others) {
  const std::vector<double> inverse = inverse_errors(observation, scales, table.row(row));
  std::vector<std::size_t> same;
  for (const std::size_t other : others)
    if (other != row && are_same(table.row(row), table.row(other), inverse)) same.push_back(other);
  return same;
}

}  // namespace voussoir
