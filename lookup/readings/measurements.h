#pragma once
/// @file What was measured, by channel: one number of one sensor.

#include <span>
#include <vector>

namespace voussoir {

/// Readings in the order of a library's channels. Displacements in metres, tilts in radians.
struct Measurements {
  std::vector<double> displacement;  ///< [m] up is positive; NaN where there is no reading
  std::vector<double> sigma;         ///< [m] the reading's own standard deviation; NaN where none is stated
  std::vector<bool> silent;          ///< there is a sensor, but it gave no reading

  std::size_t count() const;  ///< readings
};

/// So many channels without sensors.
Measurements no_measurements(std::size_t channels);

/// Displacements [m] as readings of sensors at all points, those that are NaN being silent.
Measurements as_measurements(std::span<const double> displacements);

}  // namespace voussoir
