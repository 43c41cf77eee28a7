#pragma once
/// @file Readings beside the predictions that they are compared with.

#include <optional>
#include <string>
#include <vector>

#include "core/solve/state_name.h"
#include "lookup/readings/library.h"
#include "lookup/readings/measurements.h"
#include "lookup/readings/reading_factors.h"
#include "lookup/readings/reading_kind.h"
#include "lookup/readings/readings_file.h"
#include "lookup/readings/sampled_bridges.h"

namespace voussoir {

inline constexpr int kNoLevelling = -1;

struct Comparison {
  ReadingKind kind = ReadingKind::absolute;
  std::string history = kBuiltState;  ///< of the states that the predictions are taken from
  Library library;
  Measurements measured;         ///< by channel; a change is added to the intact bridge's prediction
  ModelError model_error;        ///< of the channels
  std::vector<int> levelling{};  ///< by channel: readings with one number share datum and tilt; empty: all do
  std::vector<double> before{};  ///< [m] by channel, of two epochs; else empty
  std::vector<double> after{};
  std::vector<Quantity> quantity{};                 ///< by channel; empty: all displacements upwards
  std::vector<std::string> load{};                  ///< by channel; empty: none
  std::shared_ptr<const ReadingFactors> factors{};  ///< of the channels; null: the bridge counts as known
  std::shared_ptr<const SampledBridges> sampled{};  ///< that the factors come from; null: the first order
};

/// Readings of displacements at a database's control points in its first state.
Comparison absolute_readings(Library library, Measurements measured);

struct ComparisonSettings {
  std::optional<std::string> history{};  ///< "built" or "lost"; nothing: what fits the readings
  std::optional<double> sigma{};         ///< [m] of readings that do not state their own
  std::optional<double> model_error{};   ///< share of a signal, in the place of what the database states
  bool known_bridge = false;             ///< what is uncertain of the bridge is left out
  std::shared_ptr<const SampledBridges> sampled{};  ///< of the database, in the place of its first order
};

/// Readings beside the predictions of the database's states. Without a wish absolute readings are compared
/// with the history `built`, all others with `lost`, or with the other one where the database lacks states.
/// Changes and absolute readings at control points are compared with the database's own table and its search
/// index; for all others a library of their own is computed, from the fields where sensors are not the
/// database's. Throws InputError for histories and loads that the database lacks, for a bridge that does not
/// stand and, unless it is to count as known, for sensors that are not the database's; Failure without the
/// fields.
Comparison compare(const ReadingsFile& file, const SensorList& list, const Database& database,
                   const ComparisonSettings& settings);

/// The channel of the file's reading number `position`.
std::size_t channel_of(const Comparison& comparison, const Reading& reading, std::size_t position);

Quantity quantity_of(const Comparison& comparison, std::size_t channel);

/// Under which a channel is read; none: the bridge's own weight alone.
std::string load_of(const Comparison& comparison, std::size_t channel);

/// Of the sensor that a channel is read at.
std::string name_without_load(const Comparison& comparison, std::size_t channel);

/// What has been added to the readings of each channel [m]: the intact bridge's prediction to changes, else
/// zero.
std::vector<double> origin_of(const Comparison& comparison);

}  // namespace voussoir
