#pragma once
/// @file What a bridge file says, as a picture: looked at before anything is computed.

#include <string>

#include "core/structure/model.h"

namespace voussoir {

/// An SVG file with blocks in the colour of their role and by their labels, soil that weighs, joints,
/// supports, control points and load cases (a row each, vehicles at their first place), metres along both
/// axes. As wide as labels need. Throws InputError where a load has no block to carry it.
std::string bridge_drawing(const Model& bridge, const BridgeDescription& description);

}  // namespace voussoir
