#pragma once
/// @file Variants of a bridge: the same structure with other parameters.

#include "core/structure/model.h"
#include "core/structure/uncertainty.h"
#include "database/records/variant_parameters.h"

namespace voussoir {

/// The bridge with other parameters. It keeps its mirror symmetry if the parameters have it, too. Throws
/// InputError if the numbers of blocks or joints are others.
Model variant_of(const Model& bridge, const VariantParameters& parameters);

/// Bridges with parameters drawn from what is uncertain (core/structure/uncertain_parameters.h). The first of
/// them do not depend on how many there are; other seeds give other bridges.
std::vector<VariantParameters> sampled_variants(const Model& bridge, const Uncertainty& uncertainty,
                                                int count, std::uint64_t seed);

/// True if images of blocks and of joints have the same parameters.
bool are_symmetric(const VariantParameters& parameters, const std::vector<Joint>& joints,
                   const MirrorSymmetry& symmetry);

}  // namespace voussoir
