#pragma once
/// @file What joints that soften unevenly in an epoch change of the intact bridge, for a database.

#include "generator/sensitivities.h"

namespace voussoir {

/// As Sensitivities::unevenness, of each kept state, to first order: by the derivatives of the displacements
/// by each joint's stiffness, and how joints' stiffnesses vary together (core/structure/uneven_stiffness.h).
/// Zero in states in which the intact bridge does not stand; nothing if joints soften alike.
std::vector<Eigen::MatrixXd> find_unevenness(const SensitivityStudy& study, const SceneStates& intact);

}  // namespace voussoir
