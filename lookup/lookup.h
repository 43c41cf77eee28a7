#pragma once
/// @file From measurements to an answer: the flow of locate-damage.

#include "lookup/answer/answer.h"
#include "lookup/answer/preparation.h"

namespace voussoir {

/// Scores the scenes of the library and ranks the best. The preparation is of the comparison's library (or of
/// an equal one) and these settings. Throws InputError if no reading can tell scenes apart, and for all but
/// changes under known conditions where sampled bridges are all that is known of the bridge's scatter.
Answer locate_damage(const Comparison& comparison, const LookupSettings& settings,
                     const Preparation& preparation);

/// The same of a single question. Throws as Preparation, too.
Answer locate_damage(const Comparison& comparison, const LookupSettings& settings);

}  // namespace voussoir
