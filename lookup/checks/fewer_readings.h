#pragma once
/// @file Readings without those of some sensors, and which ones an answer hangs on.

#include <span>
#include <string_view>
#include <vector>

#include "lookup/answer/answer.h"
#include "lookup/readings/comparison.h"

namespace voussoir {

/// As if there were no such sensors: they are not silent, which would speak for the loss of their blocks.
Comparison without_readings(Comparison comparison, std::span<const std::size_t> channels);

/// The channels at points or sensors of these names, "F64,N-west", under all loads. Throws InputError for a
/// name without a reading.
std::vector<std::size_t> channels_at(const Comparison& comparison, std::string_view names);

/// May sensors be held against what the answer lets expect? Not of a known bridge against a scene that falls,
/// which shows its snapshot, nor where readings that may be wrong decide: all that is expected hangs on them.
/// Precondition: there are candidates.
bool are_sensors_judged(const Answer& answer);

/// The answer's residuals: where sensors are not judged none disagrees but the readings that decide.
std::vector<SensorResidual> told_residuals(const Answer& answer);

/// The two readings that disagree most with all others, if some do: Fit::suspects.
std::vector<std::vector<std::size_t>> suspects_among(const std::vector<SensorResidual>& residuals);

/// Fit::suspects of an answer that they may keep from being one: nothing explains the readings, or they do
/// not tell whether blocks are missing.
std::vector<std::vector<std::size_t>> suspects_of(const Answer& answer);

}  // namespace voussoir
