#pragma once
/// @file Bridges that trials take their readings from: not the database's own, but sampled ones, solved
/// nonlinearly.

#include <vector>

#include "database/records/database.h"

namespace voussoir {

/// What the control points show in a scene [m], up is positive; NaN where the point's block is gone.
struct TrueScene {
  Scene scene;
  std::vector<double> built;    ///< the blocks were missing from the start
  std::vector<double> lost;     ///< they went under load
  std::vector<double> added{};  ///< what a load case adds then; empty: none is asked about
};

struct TrueBridge {
  std::vector<double> intact;      ///< what the control points show of it [m]
  std::vector<TrueScene> damaged;  ///< scenes that stand, as built and as lost, and under the load
  std::vector<double> added{};     ///< what a load case adds to the intact bridge [m]; empty, too
};

/// All variants of a database but the nominal one. `load`: a stage of a load case; none if empty. Throws
/// Failure if there is none, if the database lacks the states built, lost and, after that, the load, or if an
/// intact bridge does not stand.
std::vector<TrueBridge> read_true_bridges(const Database& database, const std::string& load = {});

/// What a load adds: `loaded` less `unloaded`.
std::vector<double> added_by_load(std::vector<double> loaded, const std::vector<double>& unloaded);

}  // namespace voussoir
