#pragma once
/// @file How fast lookups are, in process.

#include <optional>
#include <string>
#include <vector>

#include "lookup/lookup.h"
#include "tools/benchmarks/timing.h"

namespace voussoir {

struct LookupTimings {
  std::vector<Timing> searches;  ///< the ten best under Eq. 1; all give the same rows
  std::vector<Timing> posteriors;
  std::vector<Timing> genetic;
  std::size_t disagreements =
      0;  ///< queries in which a fast search's rows, order or values differ from the scan's
  double largest_difference = 0.0;  ///< of a screened probability from the exact one
};

struct LookupQueries {
  int count = 150;
  std::uint64_t seed = 1;
  std::optional<double> level{};  ///< of the noise; nothing: even in 1..10 %
};

/// The same queries for every method: random scenes (with 0, 1, 2.. missing blocks equally often) with
/// uniform noise.
LookupTimings time_lookups(const Library& library, const LookupQueries& queries);

/// The same of as many rows as triples are: no FLANN and no evidence of every row, whose memory grows with
/// rows and queries, and no genetic search.
LookupTimings time_lookups_of_triples(const Library& library, const LookupQueries& queries);

}  // namespace voussoir
