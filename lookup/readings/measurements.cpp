#include "lookup/readings/measurements.h"

#include <algorithm>
#include <cmath>

#include "core/not_a_number.h"

namespace voussoir {

std::size_t Measurements::count() const {
  return static_cast<std::size_t>(std::count_if(displacement.begin(), displacement.end(),
                                                [](double value) { return !std::isnan(value); }));
}

Measurements no_measurements(std::size_t channels) {
  return {std::vector<double>(channels, kNan), std::vector<double>(channels, kNan),
          std::vector<bool>(channels, false)};
}

Measurements as_measurements(std::span<const double> displacements) {
  Measurements result = no_measurements(displacements.size());
  for (std::size_t i = 0; i < displacements.size(); ++i) {
    result.displacement[i] = displacements[i];
    result.silent[i] = std::isnan(displacements[i]);
  }
  return result;
}

}  // namespace voussoir
