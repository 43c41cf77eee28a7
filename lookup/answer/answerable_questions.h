#pragma once
/// @file Which questions have an answer.

#include "lookup/answer/lookup_settings.h"
#include "lookup/readings/observation.h"

namespace voussoir {

/// Throws InputError for readings that these settings do not go with: both epochs of readings that have one,
/// or of a bridge that counts as known; all but changes under known conditions where sampled bridges are all
/// that is known of the bridge's scatter; changes without an error.
void require_answerable(const Comparison& comparison, const LookupSettings& settings,
                        const Observation& observation);

}  // namespace voussoir
