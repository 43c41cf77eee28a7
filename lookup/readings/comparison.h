#pragma once
/// @file Readings beside the predictions that they are compared with.

#include <string>
#include <vector>

#include "database/records/state_name.h"
#include "lookup/readings/library.h"
#include "lookup/readings/measurements.h"

namespace voussoir {

/// What a reading is the difference of.
enum class ReadingKind {
  absolute,    ///< displacement since the bridge carried nothing: the paper's
  change,      ///< between two epochs under the bridge's own weight
  load,        ///< what a load case adds
  load_change  ///< how much more it adds in the second of two epochs
};

constexpr bool is_change(ReadingKind kind) {
  return kind == ReadingKind::change || kind == ReadingKind::load_change;
}

inline constexpr int kNoLevelling = -1;

struct Comparison {
  ReadingKind kind = ReadingKind::absolute;
  std::string history = kBuiltState;  ///< of the states that the predictions are taken from
  Library library;
  Measurements measured;         ///< by channel; a change is added to the intact bridge's prediction
  ModelError model_error;        ///< of the channels
  std::vector<int> levelling{};  ///< by channel: readings with one number share datum and tilt; empty: all do
};

/// Readings of displacements at a database's control points in its first state.
Comparison absolute_readings(Library library, Measurements measured);

}  // namespace voussoir
