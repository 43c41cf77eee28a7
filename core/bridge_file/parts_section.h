#pragma once
/// @file What is laid in courses: the tables [wall] and [[walls]] of a bridge file.

#include "core/bridge_file/toml_section.h"
#include "core/structure/bridge_description.h"

namespace voussoir {

/// Of a wall or a part: a mistyped number should not fill the memory.
inline constexpr int kMostCourses = 1000;

/// Reads [wall]. Throws InputError "file:line: message".
void read_wall(TomlSection section, WallDescription& wall);

/// Reads one of [[walls]]: the keys of [wall], and where it stands and what it is. length_m and courses have
/// to be there; course height, block length, bond and smallest block are the wall's if left out.
WallPart read_part(TomlSection section, const WallDescription& wall);

/// A role by its name. `of` is for messages: where it stands.
void read_role(TomlSection& section, const char* key, BlockRole& role);

}  // namespace voussoir
