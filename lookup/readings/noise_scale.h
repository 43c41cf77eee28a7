#pragma once
/// @file The scale of a reading's error, the formulas that all of lookup uses (noise_model.h), for single
/// numbers and for lanes.

#include "core/simd/lanes.h"

namespace voussoir {

/// The instrument's error of a reading that shows a movement of this size: slope |movement| + offset.
template <class T>
VOUSSOIR_INLINE T noise_scale(const T& slope, const T& offset, const T& movement) {
  return slope * movement + offset;
}

/// Variance of the model's own error in a prediction whose signal is d - d(intact): `fixed` is the variance
/// of the intact prediction and of what all points of the scene share, `share_square` the square of the
/// share of the signal.
template <class T>
VOUSSOIR_INLINE T model_variance(const T& fixed, double share_square, const T& signal) {
  return fixed + share_square * (signal * signal);
}

}  // namespace voussoir
