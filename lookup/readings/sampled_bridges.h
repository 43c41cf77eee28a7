#pragma once
/// @file What bridges drawn at random and solved nonlinearly (build-database --variants) show of how a
/// database's settlements scatter, in the form of sensitivities.
///
/// Bridge v, whose parameters theta_v are known, differs from the nominal one in a scene by x_v. The first
/// order explains J theta_v of it, and the covariance of N bridges is taken as
///
///   J J^T + (1 / N) sum_v r_v r_v^T,   r_v = x_v - J theta_v,
///
/// J J^T being what the first order says of all bridges, not of these N, and r_v what it leaves (second
/// order, uncorrelated with theta). So what few samples leave out is only of what the first order leaves. The
/// factors' columns are those of J, and r_v / sqrt(N). Moments are about the nominal bridge: by what it is
/// off from the mean they are larger. The same column is the same bridge in all scenes and states, so that
/// what they have in common is kept.
///
/// Without a first order r_v is x_v: every direction that no bridge took counts as exactly known.

#include <memory>

#include "database/records/database.h"

namespace voussoir {

/// What says how the readings of a bridge scatter that is not exactly known.
enum class ScatterEvidence {
  first_order,  ///< the database's sensitivities
  variants      ///< its sampled bridges, solved nonlinearly (SampledBridges)
};

/// Fewer are refused: beside the first order, and alone (docs/uncertainty.md).
inline constexpr std::size_t kFewestBridges = 10;
inline constexpr std::size_t kFewestAlone = 20;

struct SampledBridges {
  std::size_t count = 0;         ///< bridges whose intact state stands
  bool has_first_order = false;  ///< otherwise nothing is known of epochs and of the bridge's parameters
  /// A and E as the rest of the program takes them. The columns of A that are samples are no directions of
  /// parameters: there the basis is zero. A scene of which fewer than kFewestBridges stand has the first
  /// order's factors alone, widened by what that leaves of others.
  Sensitivities sensitivities;
};

/// Throws Failure, which says what to do, if the database has too few variants or none of their singles.
SampledBridges sampled_bridges(const Database& database);

/// The same where they are the evidence; null if that is the first order.
std::shared_ptr<const SampledBridges> sampled_bridges(const Database& database, ScatterEvidence evidence);

}  // namespace voussoir
