#pragma once
/// @file Gaussian readings with unknowns that are no damage, marginalised in closed form: they are linear and
/// Gaussian, too.

#include "lookup/evidence/row_statistics.h"

namespace voussoir {

/// The covariance of a row's readings is D + Phi Phi', D the diagonal of the squared scales and Phi the
/// nuisance columns times their prior deviations (Observation::levelling, and unknown_scale times the
/// movements). `sum_square` is y' (D + Phi Phi')^-1 y of the differences y, `sum_log_scale` half the
/// logarithm of the determinant, so that the Gaussian likelihood follows from them as it does without
/// unknowns (Woodbury's identity and the matrix determinant lemma); `sum_absolute` says with NaN that a scene
/// is impossible.
TableStatistics nuisance_statistics(const Observation& observation, const ErrorScales& scales,
                                    const SceneTable& table, std::span<const std::size_t> rows);

}  // namespace voussoir
