#pragma once
/// @file One variant of a bridge: a structure and its parameters.

#include "core/structure/parameters.h"
#include "core/structure/structure.h"

namespace voussoir {

struct Model : Structure {
  Parameters parameters;
};

/// The bridge of a description, everything as stated there. Throws InputError as make_structure does.
Model make_model(const BridgeDescription& description);

/// The bridge with other parameters, which are taken to have no mirror symmetry.
Model with_parameters(Model bridge, Parameters parameters);

/// A structure with the materials, fill and gravity of a description; it loses its symmetry if they have
/// none. Throws InputError if a region names neither role nor block.
Model with_nominal_parameters(Structure structure, const BridgeDescription& description);

}  // namespace voussoir
