#include "lookup/readings/simulate.h"

#include <cmath>
#include <limits>

#include "core/error.h"
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
    if (random.uniform() < noise.silence) value = std::numeric_limits<double>::quiet_NaN();
  }
  return as_measurements(readings);
}

std::string to_csv(const Measurements& readings, const std::vector<StoredPoint>& points) {
  std::string text = "point,uy_mm\n";
  for (std::size_t i = 0; i < points.size(); ++i)
    text += fmt::format("{},{}\n", points[i].name,
                        readings.silent[i] ? "" : fmt::format("{:.4f}", 1e3 * readings.displacement[i]));
  return text;
}

}  // namespace voussoir
