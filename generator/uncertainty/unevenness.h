#pragma once
/// @file What differs from part to part of the intact bridge in an epoch, for a database.

#include "generator/uncertainty/sensitivities.h"

namespace voussoir {

/// As Sensitivities::unevenness, of each kept state, to first order: by the derivatives of the displacements
/// by each joint's stiffness and each block's temperature, and how these vary together
/// (core/structure/unevenness.h). Zero in states in which the intact bridge does not stand; nothing if
/// nothing is uneven.
std::vector<Eigen::MatrixXd> find_unevenness(const SensitivityStudy& study, const SceneStates& intact);

}  // namespace voussoir
