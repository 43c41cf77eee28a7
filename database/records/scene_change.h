#pragma once
/// @file What a loss changes in how readings depend on what nobody knows of the bridge.

#include "database/records/sensitivities.h"

namespace voussoir {

/// A scene's factors less the intact bridge's, and what is left of its signal. Where a block is gone (rows
/// are zero) nothing is read and nothing changes.
SceneFactors change_of(SceneFactors scene, const SceneFactors& intact);

/// What the first order leaves of a signal (FirstOrderResidual) goes along what it knows: as an error of
/// every point by itself it would make scenes likely that scatter little. So many times as large is what a
/// loss changes then.
double widening(double share, double common);

/// The same of an epoch's parameters, as far as no sampled bridges show what is left of this signal (columns
/// of `left` that are not zero).
double widening_of_epoch(const FirstOrderResidual& residual, const Eigen::Ref<const Eigen::MatrixXd>& left);

}  // namespace voussoir
