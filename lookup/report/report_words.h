#pragma once
/// @file What the text and the page say in the same words.

#include <string>
#include <string_view>
#include <vector>

#include "lookup/answer/answer.h"
#include "lookup/readings/comparison.h"
#include "lookup/weighed_databases.h"

namespace voussoir {

/// What the answer comes to, a sentence or a few, the most important first. Precondition: there is a
/// candidate.
std::vector<std::string> conclusions_in_words(const Answer& answer, const Library& library);

/// "located (at least 90 % sure that each block named is missing)"
std::string verdict_in_words(const Answer& answer);

/// The verdict as a sentence: "Block 10,4 is missing (98.2 %)." Without probabilities nothing.
std::string headline(const Answer& answer, const Comparison& comparison);

/// What the first candidate is: "most likely", or only "likeliest of many" where the verdict names no scene,
/// "likeliest by belief" where that alone makes the intact bridge so, "closest" if nothing explains the
/// readings, "nearest by misfit" if the search did not find the likeliest scene, "best match" without
/// probabilities.
std::string_view first_candidate_in_words(const Answer& answer);

/// "99.1 %  clamped.h5 (digest 0123456789ab): intact, first intact"
std::string in_words(const AskedDatabase& database);

/// Of a bridge that Source::stands_by_slip.
inline constexpr std::string_view kStandsBySlip =
    "it stands intact only by what its joints have slid, which depends on how it was loaded";

/// "22579 scenes", and how many were left out for which reason.
std::string searched_in_words(const Answer& answer);

/// The losses that stay open (open_losses) as a sentence; empty if there are none.
std::string open_losses_in_words(const Answer& answer, const Library& library);

/// "Without F64: Block 4,1 is missing (> 99.9 %).": what the readings say without one that may be wrong;
/// empty if none is suspected.
std::string without_in_words(const Answer& answer, const Comparison& comparison);

/// Names of the sensors that AnswerWithout leaves out.
std::vector<std::string> suspects_in_words(const Answer& answer, const Comparison& comparison);

/// What is taken to be known and uncertain of the bridge.
std::string bridge_in_words(const Answer& answer);

/// What relative errors are shares of: "displacement", or "change" where readings are changes.
std::string_view errors_are_shares_of(ReadingKind kind);

/// "at most 9.7 % of the displacement (uniform noise, estimated)"
std::string noise_in_words(const NoiseEstimate& noise, const Comparison& comparison);

/// How far a candidate is behind the best: the ratio of probabilities or, without them, of misfits their
/// difference.
std::string behind(const Candidate& candidate, const Candidate& best);

/// The scenes that the sensors cannot tell from a candidate, the likeliest ones by name; empty if there are
/// none.
std::string same_in_words(const Candidate& candidate, const Library& library);

/// "0: < 0.1 %, 1: 91.5 %, 2: 8.5 %"
std::string missing_in_words(const Answer& answer);

/// What goes with shares that are no probabilities (has_probabilities): ", if one of the scenes were the
/// truth"; nothing otherwise.
std::string_view if_true(const Answer& answer);

/// A sentence for each sensor that disagrees with the rest, the farthest first, at most five.
std::vector<std::string> odd_sensors(const Answer& answer, const Comparison& comparison);

}  // namespace voussoir
