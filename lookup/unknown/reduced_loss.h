#pragma once
/// @file What the loss of a block, or of several, changes in the directions of a screen.

#include <array>
#include <type_traits>
#include <vector>

#include "lookup/unknown/screen_directions.h"
#include "lookup/unknown/unknown_bridge.h"

namespace voussoir {

inline constexpr std::size_t kEpochColumns = 4;  ///< combinations of an epoch's parameters, the leading

/// What a loss adds to a covariance in the directions of a scene with 1, 2 .. losses, beside the outer
/// product of what the losses' columns in common sum up to.
template <class Number>
using ReducedPart = std::array<std::array<Number, lower_size(kDirections)>, kMostLosses>;

/// A loss in the directions, in double or single precision.
template <class Number>
struct LossInDirections {
  std::array<Number, kDirections> signal{};
  std::array<Number, kDirections* static_cast<std::size_t>(kFirstColumns)> first{};  ///< of A
  std::array<Number, kDirections * kEpochColumns> epoch{};  ///< of E, conditions being as the file states
  ReducedPart<Number> of_bridge{}, of_epoch{};
  std::array<Number, lower_size(kDirections)> model_error{};
};

/// A loss in the directions in both precisions; and by channel, filled up for lanes.
struct ReducedLoss {
  LossInDirections<double> exact;
  LossInDirections<float> rounded;
  std::vector<double> signal;  ///< zero where there is no reading
  std::vector<double> shown;   ///< with that of the intact bridge

  template <class Number>
  const LossInDirections<Number>& in() const {
    if constexpr (std::is_same_v<Number, float>)
      return rounded;
    else
      return exact;
  }
};

/// From a loss's product with what the intact bridge has, and its own without the columns in common. What two
/// losses have in common otherwise is bounded by the own products of both, so that these count once for each
/// loss.
ReducedPart<double> reduced_part(const DirectionTriangle& crossed, const DirectionTriangle& own);

LossInDirections<float> rounded(const LossInDirections<double>& loss);

}  // namespace voussoir
