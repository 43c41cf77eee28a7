#pragma once
/// @file What readings are compared with.

#include <memory>
#include <string>
#include <vector>

#include "database/records/database.h"
#include "lookup/readings/sensor.h"

namespace voussoir {

/// The numbers of a library that is no database's own table.
struct LibraryStorage {
  std::vector<double> predictions;       ///< rows x channels [m or rad]
  std::vector<std::uint8_t> outcome;     ///< of each row, values of Outcome
  std::vector<double> standing_share{};  ///< of each row, as SceneTable has it
};

/// Which bridge shows what is looked at.
enum class BridgeShown {
  as_stated,       ///< just that of the bridge file
  not_quite_known  ///< one that may stand where that one falls (Database::table_if_standing)
};

/// Predictions of every scene. A column of the table is a channel: what one sensor shows in one state, or in
/// one state against another. In a library of a database's own table the channels are the control points.
struct Library {
  SceneTable table;  ///< a row for each scene, a column for each channel
  std::vector<StoredPoint>
      points;  ///< the channels: name, place, and the block without which one shows nothing
  const BlockLayout& layout;
  SearchIndex index{};                              ///< of `table`; without clusters if there is none
  std::shared_ptr<const LibraryStorage> storage{};  ///< what `table` looks into, unless it is the database
};

/// The control points in one state of the nominal variant; refers to the database.
Library library_of(const Database& database, std::size_t state = 0,
                   BridgeShown shown = BridgeShown::as_stated);

/// A sensor in a state, or what a load adds to its reading.
struct Channel {
  const Sensor* sensor = nullptr;
  std::size_t point = 0;  ///< of a control point its number
  std::string load{};     ///< its name; none: the bridge's own weight alone
  std::optional<std::size_t>
      loaded{};  ///< the state under the load; nothing: the reading is of the state `base`
};

/// What stands behind a sensor's name in that of a channel: " under truck@2", nothing without a load.
std::string under_load(const std::string& load);

/// One column for each channel. `base` is the state without loads. Where a channel is what a load adds and
/// the scene does not stand in one of the two states, it shows NaN: nobody reads such a difference. A scene
/// is unresolved if one of its states is. Throws Failure if a sensor needs fields that the database does not
/// have.
Library library_of_channels(const Database& database, std::size_t base, const std::vector<Channel>& channels,
                            BridgeShown shown);

/// Throws Failure naming the scene and what was expected if of this one only the outcome is known.
void expect_displacements(const Library& library, std::size_t row);

/// The row of the intact bridge. Throws Failure if there is none.
std::span<const double> intact_predictions(const SceneTable& table);

}  // namespace voussoir
