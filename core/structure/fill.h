#pragma once
/// @file Soil over the rings that only weighs.

#include "core/structure/structure.h"

namespace voussoir {

/// Mass of the soil on each node [kg]: at every x it rests on what lies highest there, and goes with it. As
/// deep out of plane as the bridge's material says. Zero gravity gives none.
Eigen::VectorXd fill_masses(const BridgeDescription& description, const Structure& structure);

}  // namespace voussoir
