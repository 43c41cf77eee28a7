#pragma once
/// @file What a load on the top of the intact bridge adds to its readings, to first order.

#include "generator/uncertainty/scene_derivatives.h"

namespace voussoir {

/// Sensitivities::load: of the intact bridge under its own weight. Nothing if it does not stand.
LoadInfluence find_load_influence(const SensitivityStudy& study, const SensitivityEquations& equations,
                                  const SceneStates& intact);

}  // namespace voussoir
