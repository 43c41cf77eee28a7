#pragma once
/// @file Reading [[mortar]] of a bridge file.

#include <string>
#include <vector>

#include "core/bridge_file/toml_section.h"
#include "core/structure/bridge_description.h"

namespace voussoir {

/// `description` has its joints and regions. Throws InputError "file:line: message".
std::vector<MortarRegion> read_mortar(const toml::array& tables, const std::string& file,
                                      const BridgeDescription& description);

}  // namespace voussoir
