#pragma once
/// @file Losses that readings of the lost block itself exclude, and which of them the other readings may
/// show.

#include <span>
#include <vector>

#include "lookup/readings/library.h"
#include "lookup/search/eligible_rows.h"
#include "lookup/unknown/intact_gaussian.h"

namespace voussoir {

/// One block is missing, and something on it or fastened to it was read all the same.
struct HiddenLoss {
  std::size_t row = 0;                ///< of the scene table
  std::vector<std::size_t> channels;  ///< that were read, and have no value without the block
  double gain = 0.0;  ///< by how much the logarithm of the other readings' density is larger than with no
                      ///< block missing, under the intact bridge's covariance, the loss of any size
};

/// Of all eligible scenes with one block missing those that readings on it alone exclude (and no load under
/// which they do not stand), and others could show; the largest gain first, in the best case of each.
std::vector<HiddenLoss> hidden_losses(const UnknownBridge& bridge, const Observation& observation,
                                      const Library& library, const Eligible& eligible,
                                      std::span<const IntactGaussian> gaussians);

}  // namespace voussoir
