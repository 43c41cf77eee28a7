#pragma once
/// @file Bridges that trials take their readings from: not the database's own, but sampled ones, solved
/// nonlinearly.

#include <vector>

#include "database/records/database.h"

namespace voussoir {

/// What the control points show in a scene [m], up is positive; NaN where the point's block is gone.
struct TrueScene {
  Scene scene;
  std::vector<double> built;  ///< the blocks were missing from the start
  std::vector<double> lost;   ///< they went under load
};

struct TrueBridge {
  std::vector<double> intact;      ///< what the control points show of it [m]
  std::vector<TrueScene> damaged;  ///< scenes that stand, as built and as lost
};

/// All variants of a database but the nominal one. Throws Failure if there is none, if the database lacks
/// the states built and lost, or if an intact bridge does not stand.
std::vector<TrueBridge> read_true_bridges(const Database& database);

}  // namespace voussoir
