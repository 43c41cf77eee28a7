#pragma once
/// @file Regions of a bridge with materials of their own.

#include "core/structure/model.h"

namespace voussoir {

/// Gives every block the material of the last region that names its role or its label, and every joint the
/// softer, less rough of what the regions of its two blocks say. Throws InputError if a region names what is
/// neither a role nor a block.
void set_regions(const BridgeDescription& description, const Structure& structure, Parameters& parameters);

/// Are blocks, joints and soil the same as those of their mirror images? Precondition: the bridge has a
/// symmetry.
bool has_symmetric_parameters(const Model& bridge);

}  // namespace voussoir
