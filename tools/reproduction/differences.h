#pragma once
/// @file Where this model and this run differ from the paper, and why.

#include <vector>

#include "tools/reproduction/experiments.h"
#include "tools/reproduction/subject.h"

namespace voussoir {

/// Topic, paper, here, why; only what the cases say of the paper is compared.
Table differences(const Subject& subject, const std::vector<CaseResult>& one_block,
                  const std::vector<CaseResult>& two_blocks,
                  const std::vector<GenerationsAtNoise>& generations);

}  // namespace voussoir
