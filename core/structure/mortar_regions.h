#pragma once
/// @file Which joint has which mortar.

#include "core/structure/bridge_description.h"
#include "core/structure/parameters.h"
#include "core/structure/structure.h"

namespace voussoir {

/// Gives every joint the mortar and the stiffnesses of the last region that it lies in. Throws InputError if
/// a region names a label that no block has, or if blocks are halved and nothing holds the halves together.
void lay_mortar(const BridgeDescription& description, const Structure& structure, Parameters& parameters);

}  // namespace voussoir
