#pragma once
/// @file What bridges drawn at random and solved nonlinearly (build-database --variants) show of how a
/// database's settlements scatter, in the form of sensitivities.
///
/// N bridges give a scene's covariance about the nominal bridge, S = sum_v x_v x_v^T / N, x_v being how variant
/// v differs from it; what the nominal bridge is off from their mean is in it. So few bridges leave most
/// directions out that a bridge has, as if it were exactly known there. So the first order, J J^T, counts as
/// kFirstOrderBridges more of them,
///
///   (kFirstOrderBridges J J^T + N S) / (kFirstOrderBridges + N),
///
/// which is the mean of a covariance after N samples if it has an inverse Wishart distribution around J J^T
/// beforehand. Columns are those of J and the samples x_v, each with the root of its weight. Of two states or
/// scenes of one bridge the same columns are the same bridges, so that what they have in common is kept.

#include <memory>

#include "database/records/database.h"

namespace voussoir {

/// What says how the readings of a bridge scatter that is not exactly known.
enum class ScatterEvidence {
  first_order,  ///< the database's sensitivities
  variants      ///< its sampled bridges, solved nonlinearly (SampledBridges)
};

/// So many sampled bridges say as much of a covariance as the first order (docs/uncertainty.md).
inline constexpr double kFirstOrderBridges = 20.0;

/// Fewer are refused: with the first order, and of changes without it.
inline constexpr std::size_t kFewestBridges = 10;
inline constexpr std::size_t kFewestAlone = 20;

struct SampledBridges {
  std::size_t count = 0;         ///< bridges whose intact state stands
  bool has_first_order = false;  ///< otherwise nothing is known of epochs, nor of directions that no bridge took
  /// A and E as the rest of the program takes them. The columns of A are no parameters of the bridge, of which
  /// samples say next to nothing: the basis has no rows.
  Sensitivities sensitivities;
};

/// Throws Failure, which says what to do, if the database has too few variants or none of their singles.
SampledBridges sampled_bridges(const Database& database);

/// The same where they are the evidence; null if that is the first order.
std::shared_ptr<const SampledBridges> sampled_bridges(const Database& database, ScatterEvidence evidence);

}  // namespace voussoir
