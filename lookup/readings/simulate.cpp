#include "lookup/readings/simulate.h"

#include <cmath>

#include "core/error.h"
#include "core/not_a_number.h"
#include "lookup/readings/noise_scale.h"

namespace voussoir {
namespace {

double draw_laplace(Random& random) {
  const double u = 1.0 - random.uniform();  // in (0, 1]
  const double size = -std::log(u) / std::sqrt(2.0);
  return random.below(2) == 0 ? size : -size;
}

/// Student's t scaled to a standard deviation of one (Bailey, "Polar generation of random variates with the
/// t-distribution", Mathematics of Computation 62, 1994).
double draw_student(double nu, Random& random) {
  for (;;) {
    const double x = 2.0 * random.uniform() - 1.0;
    const double y = 2.0 * random.uniform() - 1.0;
    const double w = x * x + y * y;
    if (w > 0.0 && w < 1.0)
      return x * std::sqrt(nu * (std::pow(w, -2.0 / nu) - 1.0) / w) * std::sqrt((nu - 2.0) / nu);
  }
}

/// Adds to all heights of a levelling a shift and a rotation.
void add_levelling_errors(const Comparison& comparison, const Nuisance& nuisance, Random& random,
                          Measurements& measured) {
  const Eigen::MatrixXd columns = levelling_columns(comparison, measured, nuisance);
  Eigen::VectorXd drawn(columns.cols());
  for (double& one : drawn) one = random.gaussian();
  const Eigen::VectorXd errors = columns * drawn;
  for (std::size_t i = 0; i < measured.displacement.size(); ++i)
    measured.displacement[i] += errors[static_cast<Eigen::Index>(i)];
}

/// What a load adds is a difference, which nobody reads of what falls, whatever the database keeps of it.
void expect_readings(const Comparison& comparison, std::size_t row) {
  const Library& library = comparison.library;
  if (!is_loaded(comparison.kind)) return expect_displacements(library, row);
  if (library.table.has_displacements(row)) return;
  throw Failure(fmt::format(
      "scene {} does not stand both under the load and without it, so that nobody reads what the load adds: "
      "expected a scene that does",
      to_string(library.table.scene(row), library.layout)));
}

/// An error in units of sigma. Precondition: shape is not automatic.
double draw_error(NoiseShape shape, double degrees_of_freedom, Random& random) {
  switch (shape) {
    case NoiseShape::laplace:
      return draw_laplace(random);
    case NoiseShape::student:
      return draw_student(degrees_of_freedom, random);
    case NoiseShape::gaussian:
      return random.gaussian();
    default:
      return 2.0 * random.uniform() - 1.0;
  }
}

}  // namespace

Measurements simulate_readings(std::span<const double> displacements, const NoiseModel& noise,
                               Random& random) {
  std::vector<double> readings(displacements.begin(), displacements.end());
  for (double& value : readings) {
    if (std::isnan(value)) continue;
    value += noise_scale(*noise.relative, noise.floor, std::abs(value)) *
             draw_error(noise.shape, noise.degrees_of_freedom, random);
    if (random.uniform() < noise.silence) value = kNan;
  }
  return as_measurements(readings);
}

ReadingsFile blank_file(const SensorList& list, ReadingKind kind, const std::vector<std::string>& loads) {
  ReadingsFile file{"", kind, false, {}};
  const std::vector<std::string> or_none = loads.empty() ? std::vector<std::string>{""} : loads;
  for (const std::string& load : or_none)
    for (std::size_t sensor = 0; sensor < list.sensors.size(); ++sensor)
      file.readings.push_back(
          {.sensor = sensor, .load = load, .value = kNan, .before = kNan, .after = kNan, .sigma = kNan});
  return file;
}

ReadingsFile simulate_file(const ReadingsFile& blank, const Comparison& comparison, std::size_t row,
                           const NoiseModel& noise, const Nuisance& nuisance, Random& random) {
  const std::vector<double> origin = origin_of(comparison);
  expect_readings(comparison, row);
  const std::span<const double> prediction = comparison.library.table.row(row);
  std::vector<double> truth(prediction.size());
  for (std::size_t i = 0; i < truth.size(); ++i) truth[i] = prediction[i] - origin[i];
  Measurements measured = simulate_readings(truth, noise, random);
  add_levelling_errors(comparison, nuisance, random, measured);
  const bool sigma_says_all =
      noise.shape == NoiseShape::gaussian && noise.relative == 0.0 && noise.floor > 0.0;
  ReadingsFile file = blank;
  for (std::size_t i = 0; i < file.readings.size(); ++i) {
    Reading& reading = file.readings[i];
    const std::size_t channel = channel_of(comparison, reading, i);
    reading.value = measured.displacement[channel];
    reading.silent = measured.silent[channel];
    reading.before = origin[channel];
    reading.after = reading.before + reading.value;
    if (sigma_says_all) reading.sigma = noise.floor;
  }
  return file;
}

}  // namespace voussoir
