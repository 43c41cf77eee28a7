#pragma once
/// @file What a bridge file says, as a picture: looked at before anything is computed.

#include <string>

#include "core/structure/model.h"

namespace voussoir {

/// An SVG file with blocks in the colour of their role and by their labels, joints, supports, control points
/// and load cases (vehicles at their first place), a metre along both axes. Throws InputError where a load
/// has no block to carry it.
std::string bridge_drawing(const Model& bridge, const BridgeDescription& description);

}  // namespace voussoir
