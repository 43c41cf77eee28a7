#pragma once
/// @file Lines of levelling whose readings are all off alike: each has a datum, a tilt and a drift of its
/// own, of which nobody says anything.

#include <span>
#include <vector>

#include "lookup/unknown/unstated_cause.h"

namespace voussoir {

/// Of what was levelled at once (Comparison::levelling), of the points whose names differ by their number
/// alone, T1 to T40, or of both: all of it, or from one of its points on, as the instrument was set up anew.
struct LineError {
  std::vector<std::size_t> channels;  ///< in ascending order, all under the same load
  bool first_epoch = false;           ///< at the first of two times, which counts by itself
  double chance = 0.0;                ///< [-] of such an error, beforehand
  double size = 0.0;  ///< [m] root mean square of what it most likely adds with no block missing
  UnstatedCause cause;
};

/// Of each line of three points and more, beside which others were levelled, what is likeliest of the whole,
/// and of a part, beside the intact bridge; the likeliest first. What a stated datum or tilt of levellings
/// allows for is none.
std::vector<LineError> line_errors(const UnknownBridge& bridge, const Observation& observation,
                                   const Comparison& comparison, std::span<const IntactGaussian> gaussians,
                                   std::size_t count);

}  // namespace voussoir
