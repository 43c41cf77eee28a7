#pragma once
/// @file Settings for who wants to know only whether scenes fall, and what falls.
///
/// Then motion need not show a field at a stated moment, and may decide sooner: gravity grows in as many
/// periods of the bridge as it does of the reference bridge, which are shorter where joints are stiff; and
/// falls are looked for near the missing blocks first (near_falls.h). What stands is Newton's. What this
/// changes and gains was measured on random bridges (docs/speed.md).

#include "core/solve/settings.h"

namespace voussoir {

/// Settings whose motions say what falls, but show no fields: before acting_settings. With mortar, as they
/// are: what a quicker growth overshoots would stay damaged.
SolverSettings for_outcomes(SolverSettings settings, const Model& model);

}  // namespace voussoir
