#pragma once
/// @file Reading [[movements]] of a bridge file.

#include <string>
#include <vector>

#include "core/bridge_file/toml_section.h"
#include "core/structure/bridge_description.h"

namespace voussoir {

/// Throws InputError "file:line: message".
std::vector<MovementDescription> read_movements(const toml::array& tables, const std::string& file);

}  // namespace voussoir
