#pragma once
/// @file A question with the probabilities that it was answered with.

#include "lookup/answer/preparation.h"
#include "lookup/evidence/posterior.h"
#include "lookup/readings/comparison.h"
#include "lookup/readings/observation.h"

namespace voussoir {

/// All of them outlive this.
struct AskedReadings {
  const Comparison& comparison;
  const Observation& observation;
  const Preparation& preparation;
  const Posterior& posterior;
};

}  // namespace voussoir
