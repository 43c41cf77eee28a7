#pragma once
/// @file Do readings look like those of instruments with the errors that are stated?

#include <optional>

#include "lookup/fit.h"
#include "lookup/readings/comparison.h"

namespace voussoir {

/// A fit that explains nothing, with the reason, if ten readings or more with stated errors cannot be those of
/// such instruments: all multiples of a step that is coarser than the errors; or changes that all are zero, or
/// far below their errors, as metres or centimetres in a column of millimetres are. They would be said to show
/// that nothing is missing. Null if there is nothing to say against them.
std::optional<Fit> check_readings(const Comparison& comparison, const Observation& observation);

}  // namespace voussoir
