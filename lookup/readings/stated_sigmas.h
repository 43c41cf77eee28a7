#pragma once
/// @file Readings whose errors are stated as standard deviations.

#include <string_view>

#include "lookup/readings/measurements.h"
#include "lookup/readings/noise_model.h"

namespace voussoir {

/// "0.02mm" or "0.02" (millimetres) -> 2e-5 [m]. Throws InputError unless it is a positive number.
double parse_sigma(std::string_view text);

/// The noise of these readings. If every reading states its own standard deviation, nothing relative is left
/// to be unknown: the level is zero and, unless another shape is wanted, the shape Gaussian.
NoiseModel noise_of(const Measurements& measured, NoiseModel wanted);

}  // namespace voussoir
