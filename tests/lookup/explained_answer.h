#pragma once
/// @file An answer whose likely scene explains the readings.

#include <vector>

#include "lookup/answer/answer.h"

namespace voussoir::test {

/// With these probabilities of numbers of missing blocks, and of one block.
inline Answer explained_answer(const std::vector<double>& missing, double block) {
  Answer answer;
  answer.posterior = {.probability = {0.0, {}, {}},
                      .block_probability = {block},
                      .missing_probability = missing,
                      .credible = {0},
                      .intact_if_even = missing.front()};
  answer.fit = {.explained = true, .chance = 0.5, .reason = {}};
  return answer;
}

}  // namespace voussoir::test
