#pragma once
/// @file Do readings look like those of instruments with the errors that are stated?

#include <optional>

#include "lookup/answer/fit.h"
#include "lookup/readings/comparison.h"

namespace voussoir {

/// A fit that explains nothing, with the reason, if ten readings or more with stated errors cannot be those
/// of such instruments: all multiples of a step that is coarser than the errors; or changes that are far
/// below their errors, as metres or centimetres in a column of millimetres are, or all zero, unless what was
/// read at the first time shows that the step is fine enough.
/// They would be said to show that nothing is missing. Null if there is nothing to say against them.
std::optional<Fit> check_readings(const Comparison& comparison, const Observation& observation);

/// The same of changes that scatter about what is likely by far less than their errors let expect, as losses
/// read in centimetres do. Of a bridge that is not exactly known.
std::optional<Fit> check_scatter(const UnknownBridge& bridge, const BridgePosterior& posterior);

}  // namespace voussoir
