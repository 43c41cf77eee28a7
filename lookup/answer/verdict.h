#pragma once
/// @file The answer in one word, by numbers, and what goes with it: which blocks are named, which losses stay
/// open, and whether probabilities mean anything.

#include <string_view>
#include <vector>

#include "lookup/answer/answer.h"

namespace voussoir {

enum class Verdict {
  located,            ///< some block is missing with at least kCertain
  damaged_unlocated,  ///< blocks are missing with at least kCertain, but no single one is
  intact,       ///< no block is missing with at least kCertain, also if that had not been believed beforehand
                ///< (Posterior::intact_if_even)
  cannot_tell,  ///< none of these
  unexplained   ///< no scene explains the readings: what is likeliest among them means nothing
};

/// "located", "damaged-unlocated", "intact", "cannot-tell", "unexplained"
std::string_view to_string(Verdict verdict);

/// By the probabilities alone, whatever the prior supposes and other databases say: see verdict_of.
/// `explained`: the likeliest scene passes the predictive check (Fit).
Verdict verdict_by_probability(const Posterior& posterior, bool explained);

/// What a prior that leaves no choice supposes.
enum class Supposed { nothing, damage, no_damage };
Supposed supposed_by(const Prior& prior);

/// The same, but what a prior supposes or another database contests is not told (cannot_tell); a block that
/// is named stays so if damage was supposed. Precondition: there are probabilities.
Verdict verdict_of(const Answer& answer);

/// Does belief make the intact bridge certain where the readings alone do not? Precondition: there are
/// probabilities.
bool is_intact_by_belief(const Answer& answer);

/// The blocks that an answer names: missing for certain, likeliest first; none unless it is `located`.
std::vector<BlockId> named_blocks(const Answer& answer);

/// Of a bridge that is said to be intact: the losses that the readings do not exclude, the likeliest first.
/// Nothing with any other verdict.
std::vector<OpenLoss> open_losses(const Answer& answer);

/// Probabilities of scenes, if these may be the truth: where nothing explains the readings they are only
/// shares among scenes none of which is an answer. Without probabilities false.
bool has_probabilities(const Answer& answer);

}  // namespace voussoir
