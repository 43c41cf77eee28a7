#pragma once
/// @file When two builds give the same displacement fields.

#include <string>

#include "core/structure/bridge_description.h"
#include "database/records/provenance.h"

namespace voussoir {

/// A hash over everything that displacement fields depend on: the description of the bridge (not its name nor
/// remarks in the bridge file, but which points are measured, as signals there decide in how many steps
/// blocks are lost and which triples are composed) and what is stated of how they were made: the settings of
/// solver and generator, the solver's source, compiler and flags. Records of equal keys can be used for each
/// other.
std::string results_key(const BridgeDescription& description, const Provenance& made);

}  // namespace voussoir
