#pragma once
/// @file What scenes would show that fall in the nominal bridge, but stand in some of those drawn at random.

#include <optional>
#include <vector>

#include "database/records/database.h"
#include "database/records/sensitivities.h"

namespace voussoir {

/// In the place of a table's.
struct IfStanding {
  std::vector<double> vertical;        ///< SceneTable::vertical
  std::vector<double> standing_share;  ///< SceneTable::standing_share
};

/// Nothing if there are no uncertain falls in the state, of which the table is. Throws InputError if the file
/// has a number there that is not finite.
std::optional<IfStanding> if_standing(const SceneTable& table, const Sensitivities& sensitivities,
                                      std::size_t state, const std::vector<StoredPoint>& points);

}  // namespace voussoir
