#pragma once
/// @file Which joint has which mortar.

#include "core/structure/bridge_description.h"
#include "core/structure/parameters.h"
#include "core/structure/structure.h"

namespace voussoir {

/// Gives every joint the mortar of the last region that it lies in, and the stiffnesses that this one states;
/// otherwise the joint keeps its own. Throws InputError if a region names a label that no block has, if
/// blocks are halved and nothing holds the halves together, or if mortar would break by itself on a joint as
/// soft.
void lay_mortar(const BridgeDescription& description, const Structure& structure, Parameters& parameters);

}  // namespace voussoir
