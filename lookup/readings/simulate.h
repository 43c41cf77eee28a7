#pragma once
/// @file Readings made from a scene, for examples and for tests of the searches.

#include <span>

#include "database/records/database.h"
#include "lookup/readings/measurements.h"
#include "lookup/readings/noise_model.h"
#include "lookup/readings/random.h"

namespace voussoir {

/// d_i + sigma_i e_i with sigma_i = relative |d_i| + floor; for uniform noise without floor this is the
/// paper's d_i (1 + p U(-1, 1)). Sensors on missing blocks (NaN) are silent, and others with the noise
/// model's chance. Precondition: the noise has a level and a shape, and no model error.
Measurements simulate_readings(std::span<const double> displacements, const NoiseModel& noise,
                               Random& random);

/// The readings as a measurements file, in millimetres; silent sensors without a value.
std::string to_csv(const Measurements& readings, const std::vector<StoredPoint>& points);

}  // namespace voussoir
