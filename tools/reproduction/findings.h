#pragma once
/// @file What the paper says in words, judged by this run's numbers.

#include <string>
#include <vector>

#include "tools/reproduction/experiments.h"

namespace voussoir {

/// A statement of the paper, whether this run bears it out, and by which numbers.
struct Finding {
  std::string claim;
  bool holds = false;
  std::string evidence;
};

/// "An arch block hides a second missing block": random pairs with and without one, by Eq. 1.
Finding arch_blocks_mask(const PairSuccess& with_arch, const PairSuccess& without_arch);

/// "Blocks in high courses are easier": the upper half of the courses against the lower, by Eq. 1.
Finding high_blocks_are_easier(const std::vector<CourseSuccess>& courses);

/// "This pair is hard": its share of successful seeds against that of the other pairs of the table at the
/// same noise.
Finding pair_is_hard(const PaperCase& pair, const std::vector<CaseResult>& two_blocks);

/// "Noise raises generations": rank correlation of noise and generations over all runs that found the truth.
Finding noise_raises_generations(const std::vector<GenerationsAtNoise>& runs);

/// As a table: claim, verdict, evidence.
Table to_table(const std::vector<Finding>& findings);

/// Spearman's correlation of ranks (ties share their mean rank); 0 if one of the lists is constant.
/// Precondition: equal lengths, at least 2.
double rank_correlation(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace voussoir
