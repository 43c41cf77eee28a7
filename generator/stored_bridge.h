#pragma once
/// @file The bridge that a database is about.

#include "core/structure/bridge.h"
#include "database/records/database.h"

namespace voussoir {

/// The bridge with the blocks, mesh and control points that stand in the database and the material that its
/// bridge text states; joints and symmetry are found anew. Throws InputError if the text is no bridge file.
Bridge bridge_of(const Database& database);

}  // namespace voussoir
