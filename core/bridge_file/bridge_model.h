#pragma once
/// @file The model of a bridge file, and what of the file does nothing in it.

#include <string>
#include <vector>

#include "core/bridge_file/bridge_file.h"
#include "core/structure/model.h"

namespace voussoir {

/// make_model of the file's description. Throws InputError "file: message" for what cannot be built.
Model model_of(const BridgeFile& file);

/// A sentence for everything that the description states and that changes nothing: soil that lies below every
/// face, regions of a role that no block has.
std::vector<std::string> without_effect(const BridgeDescription& description, const Model& model);

}  // namespace voussoir
