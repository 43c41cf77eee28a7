#pragma once
/// @file How fast lookups are, in process, on one core.

#include <string>
#include <vector>

#include "lookup/lookup.h"
#include "tools/timing.h"

namespace voussoir {

struct LookupTimings {
  std::vector<Timing> searches;  ///< the ten best under Eq. 1; all give the same rows
  std::vector<Timing> posteriors;
  std::vector<Timing> genetic;
  std::size_t disagreements =
      0;  ///< queries in which a fast search's rows, order or values differ from the scan's
  double largest_difference = 0.0;  ///< of a screened probability from the exact one
};

/// The same queries for every method: random scenes (0, 1 or 2 missing blocks equally often) with uniform
/// noise, levels even in 1..10 %.
LookupTimings time_lookups(const Library& library, int queries, std::uint64_t seed);

}  // namespace voussoir
