#pragma once
/// @file The scale of a reading's error, the one formula that all of lookup uses (noise_model.h), for single
/// numbers and for lanes.

#include "core/simd/lanes.h"

namespace voussoir {

/// The sensor's own error at a place that moves by |d|: slope |d| + offset.
template <class T>
VOUSSOIR_INLINE T noise_scale(const T& slope, const T& offset, const T& movement) {
  return slope * movement + offset;
}

/// The same with the model's own error: its share of the change against the intact bridge.
template <class T>
VOUSSOIR_INLINE T noise_scale(const T& slope, const T& offset, const T& movement, double model_error,
                              const T& change) {
  return noise_scale(slope, offset, movement) + model_error * change;
}

}  // namespace voussoir
