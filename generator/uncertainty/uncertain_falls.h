#pragma once
/// @file Losses after which the bridge falls as its file states it, but bridges drawn at random stand.
///
/// A bridge that is read stands, and none is just as its file says. Where nothing was known of such losses,
/// a sound block was named for half of them (docs/uncertainty.md).

#include "core/structure/uncertain_parameters.h"
#include "generator/uncertainty/first_order_residual.h"

namespace voussoir {

/// So many bridges show whether a loss leaves them standing.
inline constexpr std::size_t kBridgesOfFalls = 16;

/// In one state.
struct SampledFall {
  std::size_t state = 0;          ///< among those that are kept
  std::size_t scene = 0;          ///< among the nominal bridge's
  UncertainFall fall{};           ///< `if_standing` on average over the sampled bridges that stand
  Eigen::MatrixXd derivatives{};  ///< points x parameters [m per standard deviation], their average
};

/// Singles in the states in which the intact bridge stands. None without a solver of equilibria (see
/// SolverChoice). Rows of points whose block is gone are zero.
std::vector<SampledFall> find_uncertain_falls(const SensitivityStudy& study,
                                              const UncertainParameters& uncertain,
                                              const FirstOrder& first_order, Progress& progress);

}  // namespace voussoir
