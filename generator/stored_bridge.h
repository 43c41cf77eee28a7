#pragma once
/// @file The bridge that a database is about.

#include "core/structure/bridge.h"
#include "database/records/database.h"

namespace voussoir {

/// The nominal bridge, with the blocks, mesh, joints and control points that stand in the database and the
/// material that its bridge text states; its symmetry is found anew. Throws InputError if the text is no
/// bridge file.
Bridge bridge_of(const Database& database);

/// A variant of it. Throws InputError for parameters that variant_of does not take.
Bridge bridge_of(const Database& database, const Bridge& nominal, std::int32_t variant);

}  // namespace voussoir
