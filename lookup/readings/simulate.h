#pragma once
/// @file Readings made from a scene, for examples and for tests of the searches.

#include <span>
#include <string>
#include <vector>

#include "core/random.h"
#include "lookup/readings/comparison.h"
#include "lookup/readings/noise_model.h"
#include "lookup/readings/nuisance.h"

namespace voussoir {

/// d_i + sigma_i e_i with sigma_i = relative |d_i| + floor; for uniform noise without floor this is the
/// paper's d_i (1 + p U(-1, 1)). Sensors on missing blocks (NaN) are silent, and others with the noise
/// model's chance. Precondition: the noise has a level and a shape, and no model error.
Measurements simulate_readings(std::span<const double> displacements, const NoiseModel& noise,
                               Random& random);

/// A file that has no readings yet: a row for every sensor of the list, under every load if there are loads.
ReadingsFile blank_file(const SensorList& list, ReadingKind kind, const std::vector<std::string>& loads);

/// The file's rows as the sensors would read them in a scene, with errors. `blank` is what `comparison` was
/// made of; of two epochs the first is what the intact bridge shows, and errors are those of the change. Of
/// `nuisance` datum and tilt are drawn, for every levelling. `row` is the scene's in the comparison's
/// library. Gaussian noise without relative part is stated as each row's sigma. Throws Failure if the scene
/// has no displacements.
ReadingsFile simulate_file(const ReadingsFile& blank, const Comparison& comparison, std::size_t row,
                           const NoiseModel& noise, const Nuisance& nuisance, Random& random);

}  // namespace voussoir
