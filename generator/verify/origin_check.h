#pragma once
/// @file What a database states of its origin against what its bridge text and settings give.

#include <string>
#include <vector>

#include "database/records/database.h"

namespace voussoir {

/// Problems, each naming the attribute or dataset: the text's SHA-256 and name, the results key of files that
/// this program has made, and numbers in the settings that would make solvers search for ever. Throws
/// InputError if the text is no bridge file.
std::vector<std::string> origin_problems(const Database& database);

}  // namespace voussoir
