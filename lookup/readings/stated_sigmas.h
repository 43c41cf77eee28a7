#pragma once
/// @file Readings whose errors are stated as standard deviations.

#include <string_view>

#include "lookup/readings/measurements.h"
#include "lookup/readings/noise_model.h"

namespace voussoir {

/// What a standard deviation may be [mm, tilts mm per m]: no instrument on a bridge is as good as the
/// smallest, and an error of ten metres tells nothing. Beyond them another unit was meant.
inline constexpr double kSmallestSigma = 5e-5, kLargestSigma = 1e4;

/// Is it a standard deviation in millimetres? Not if it is NaN.
constexpr bool is_sigma(double millimetres) {
  return millimetres >= kSmallestSigma && millimetres <= kLargestSigma;
}

/// "0.02mm" or "0.02" (millimetres) -> 2e-5 [m]. Throws InputError unless it is_sigma.
double parse_sigma(std::string_view text);

/// The noise of these readings. If every reading states its own standard deviation, nothing relative is left,
/// whatever level is wanted: it is zero and, unless another shape is wanted, the shape Gaussian.
NoiseModel noise_of(const Measurements& measured, NoiseModel wanted);

}  // namespace voussoir
