#pragma once
/// @file The answer in one word, by numbers.

#include <string_view>

#include "lookup/evidence/posterior.h"

namespace voussoir {

enum class Verdict {
  located,            ///< some block is missing with at least kCertain
  damaged_unlocated,  ///< blocks are missing with at least kCertain, but no single one is
  intact,       ///< no block is missing with at least kCertain, also if that had not been believed beforehand
                ///< (Posterior::intact_if_even)
  cannot_tell,  ///< none of these
  unexplained   ///< no scene explains the readings: what is likeliest among them means nothing
};

/// `explained`: the likeliest scene passes the predictive check (Fit).
Verdict verdict_of(const Posterior& posterior, bool explained);

/// "located", "damaged-unlocated", "intact", "cannot-tell", "unexplained"
std::string_view to_string(Verdict verdict);

}  // namespace voussoir
