#pragma once
/// @file Load cases as forces on the nodes.

#include <string>
#include <vector>

#include "core/structure/structure.h"

namespace voussoir {

/// What a load case is for one stage of a history.
struct LoadStage {
  std::string name;  ///< "truck", "truck@2" of a vehicle that moves, "truck@off" when it has gone
  Field force;       ///< [N] on the nodes of the intact bridge, 2 x nodes
};

/// The names of the stages of a load case, in their order.
std::vector<std::string> stage_names(const LoadDescription& load);

/// The stages of a load case, each to start from the one before: one, or one for each place of a vehicle that
/// moves, and one without any force if the case is to be unloaded. Forces act on the top of the intact
/// bridge. Axles beside the bridge do not act. The bridge carries what falls to `thickness` [m] of the load's
/// width. Throws InputError where there is no block to carry a load.
std::vector<LoadStage> load_stages(const LoadDescription& load, const Structure& structure, double thickness);

}  // namespace voussoir
