#pragma once
/// @file Variants of a bridge: the same structure with other parameters.

#include "core/structure/bridge.h"
#include "database/records/variant_parameters.h"

namespace voussoir {

/// The parameters that a bridge has, of every block and every joint.
VariantParameters parameters_of(const Bridge& bridge);

/// The bridge with other parameters. It keeps its mirror symmetry if the parameters have it, too. Throws
/// InputError if the numbers of blocks or joints are others, or if a parameter is not the same for all blocks
/// or all joints: the solvers take one value of each.
Bridge variant_of(const Bridge& bridge, const VariantParameters& parameters);

/// True if images of blocks and of joints have the same parameters.
bool are_symmetric(const VariantParameters& parameters, const std::vector<Joint>& joints,
                   const MirrorSymmetry& symmetry);

}  // namespace voussoir
