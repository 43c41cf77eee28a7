#pragma once
/// @file What readings are compared with.

#include <vector>

#include "database/records/database.h"

namespace voussoir {

/// Predictions of every scene. A column of the table is a channel: what one sensor shows in one state, or in
/// one state against another. In a library of a database's own table the channels are the control points.
struct Library {
  SceneTable table;  ///< a row for each scene, a column for each channel
  std::vector<StoredPoint>
      points;  ///< the channels: name, place, and the block without which one shows nothing
  const BlockLayout& layout;
  SearchIndex index{};  ///< of `table`; without clusters if there is none
};

/// The control points in one state of the nominal variant; refers to the database.
Library library_of(const Database& database, std::size_t state = 0);

}  // namespace voussoir
