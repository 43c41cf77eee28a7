#pragma once
/// @file The tables [[spans]] of a bridge file.

#include "core/bridge_file/toml_section.h"
#include "core/structure/bridge_description.h"

namespace voussoir {

/// Reads one table. Which keys there are depends on the shape (docs/shapes.md); one that is missing or does
/// not belong to the shape is refused. Throws InputError "file:line: message".
SpanDescription read_span(TomlSection section);

}  // namespace voussoir
