#pragma once
/// @file How long the questions take that locate-damage's options ask, in process, on one core.

#include <cstdint>
#include <vector>

#include "lookup/readings/library.h"
#include "tools/benchmarks/timing.h"

namespace voussoir {

/// Of one kind of question.
struct QuestionTiming {
  Timing wall;
  Timing processors;  ///< time of all of them together: what stays the same beside other work
};

/// Whole answers (observation, evidence of all scenes, posterior, noise, fit), with the model's own error as
/// the database states it, one row for each kind of question. Readings are those of random scenes with as
/// many missing blocks as the database holds, the same for every question of a kind. What does not depend on
/// readings is made once, with the first. The library's rows are the database's, or made up from them.
std::vector<QuestionTiming> time_questions(const Database& database, const Library& library, int queries,
                                           std::uint64_t seed, const std::string& only = {});

}  // namespace voussoir
