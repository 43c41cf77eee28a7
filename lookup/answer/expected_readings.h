#pragma once
/// @file What an answer lets expect of each reading.

#include <vector>

#include "lookup/answer/answer.h"
#include "lookup/readings/comparison.h"

namespace voussoir {

/// Of each channel's reading as it is shown [m] (ShownReadings): the first candidate's if the bridge is
/// known, else by all other readings too, NaN where there is no reading. Precondition: there is a candidate.
std::vector<double> expected_readings(const Answer& answer, const Comparison& comparison);

}  // namespace voussoir
