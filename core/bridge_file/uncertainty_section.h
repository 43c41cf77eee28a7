#pragma once
/// @file The table [uncertainty] of a bridge file.

#include "core/bridge_file/toml_section.h"
#include "core/structure/uncertainty.h"

namespace voussoir {

/// Reads [uncertainty]; what is left out has its default, for no real bridge is known exactly. Throws
/// InputError "file:line: message" for impossible values.
Uncertainty read_uncertainty(TomlSection section);

}  // namespace voussoir
