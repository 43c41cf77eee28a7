#pragma once
/// @file Which scenes become candidates: the likeliest, or those that a search by misfit finds.

#include <optional>
#include <vector>

#include "lookup/answer/lookup_settings.h"
#include "lookup/answer/preparation.h"

namespace voussoir {

/// So many of the best rows are compared with each candidate, however few are listed. Chosen, not tuned.
inline constexpr std::size_t kBestCompared = 10;

/// How many rows a search has to find.
std::size_t rows_wanted(const LookupSettings& settings);

struct FoundRows {
  std::vector<ScoredRow> rows;  ///< best first; those behind the candidates are only compared with them
  std::size_t candidates = 0;   ///< how many of them are listed
  std::vector<GeneticResult> genetic{};  ///< Answer::genetic
};

/// With a posterior the order is that of probabilities; an exhaustive search then finds the likeliest rows.
FoundRows found_rows(const Library& library, const Observation& observation, const Preparation& preparation,
                     const LookupSettings& settings, const std::optional<Posterior>& posterior);

}  // namespace voussoir
