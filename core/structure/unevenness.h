#pragma once
/// @file What differs from part to part of a bridge in an epoch.
///
/// Damp and frost reach one part of a bridge and not another, and so does the sun. In every epoch the
/// logarithm of each joint's stiffness and the temperature of each block have a part of their own, normal
/// with one standard deviation for all and alike where they are near each other (correlation_by_distance.h).

#include "core/structure/uncertain_parameters.h"

namespace voussoir {

struct UnevenQuantity {
  std::vector<UncertainAction> actions;  ///< none: it is even
  Eigen::MatrixXd correlations;          ///< of each with each
};

struct Unevenness {
  UnevenQuantity stiffness;    ///< of each pair of blocks that meet
  UnevenQuantity temperature;  ///< of each block

  bool is_none() const { return stiffness.actions.empty() && temperature.actions.empty(); }
};

Unevenness unevenness_of(const Structure& structure, const Uncertainty& uncertainty);

/// The stage with one epoch's, drawn at random. The same on every machine for the same seed.
Stage with_unevenness(Stage stage, const Structure& structure, const Unevenness& unevenness,
                      std::uint64_t seed);

}  // namespace voussoir
