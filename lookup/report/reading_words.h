#pragma once
/// @file What readings are, in words.

#include <string>
#include <vector>

#include "lookup/readings/comparison.h"

namespace voussoir {

/// "displacement", "change", "added by the load": for columns and axes.
std::string_view value_in_words(ReadingKind kind);

/// "absolute", "change", "load", "load-change": for programs.
std::string_view to_string(ReadingKind kind);

/// "vertical displacement [mm]", "change of tilt [mm per m]"...: the axis of a quantity.
std::string axis_in_words(ReadingKind kind, Quantity quantity);

/// Names of what gave no reading, which speaks for the loss of its block.
std::vector<std::string> silent_sensors(const Comparison& comparison);

/// "78 of 78 control points have a reading (change between two times)"
std::string readings_in_words(const Comparison& comparison, std::size_t readings);

/// "built (missing blocks were never there)", "lost (missing blocks went while the bridge carried its
/// weight)"
std::string history_in_words(const std::string& history);

/// What says how much a bridge scatters that is not exactly known: "derivatives of the stored bridge (first
/// order)", or how many sampled bridges, and what those cannot know. Precondition: there are factors.
std::string evidence_in_words(const Comparison& comparison);

}  // namespace voussoir
