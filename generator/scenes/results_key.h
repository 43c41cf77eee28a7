#pragma once
/// @file When two builds give the same displacement fields.

#include <string>

#include "core/structure/bridge_description.h"
#include "database/records/provenance.h"

namespace voussoir {

/// A hash over everything that displacement fields depend on: the description of the bridge (not its name nor
/// remarks in the bridge file, nor what is measured) and what is stated of how they were made: the settings
/// of solver and generator, the solver's source, compiler and flags. Records of equal keys can be used for
/// each other, but for those of three and more missing blocks where points_key differs, too: signals at what
/// is measured decide which of them are composed.
std::string results_key(const BridgeDescription& description, const Provenance& made);

/// The same of control points and sensors: what records read of displacement fields.
std::string points_key(const BridgeDescription& description);

}  // namespace voussoir
