#pragma once
/// @file What sensors would show of the loss of each block, before anything is read.
///
/// Readings of each loss are drawn from its Gaussian (loss_gaussian.h, conditions as the bridge file states
/// them), and the probability of every loss follows from them as in an answer, but that no two blocks are
/// missing, and that the size of conditions and the scatter of the bridge's joints are as stated.
/// docs/plan.md compares that with answers.

#include <cstdint>
#include <optional>
#include <vector>

#include "lookup/unknown/case_noise.h"

namespace voussoir {

struct SightSettings {
  double log_prior_intact = 0.0;  ///< and
  double log_prior_loss = 0.0;    ///< of the loss of each block
  double log_silence = 0.0;       ///< log of the chance that a sensor on a standing block gives no reading
  double certain = 0.9;           ///< probability with which a loss is seen, a block named
  int draws = 100;                ///< of readings, for each block
  std::uint64_t seed = 1;
};

/// How the loss of one block would show.
struct Sight {
  BlockId block;
  Eigen::Index largest_at = 0;     ///< row with the largest change
  double largest = 0.0;            ///< [m] that change, with its sign
  std::size_t silent = 0;          ///< sensors that the block takes with it
  double seen = 0.0;               ///< share of the draws in which some block is certainly missing
  double named = 0.0;              ///< and in which this one is
  std::optional<BlockId> alike{};  ///< the other block whose loss explains the draws best
};

/// Of each block without which the bridge stands and has sensitivities, ascending.
std::vector<Sight> sights_of(const UnknownBridge& bridge, const CaseNoise& noise,
                             const SightSettings& settings);

}  // namespace voussoir
