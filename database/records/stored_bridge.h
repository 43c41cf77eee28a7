#pragma once
/// @file The bridge that a database is about.

#include "core/solve/state_plan.h"
#include "core/structure/model.h"
#include "database/records/database.h"

namespace voussoir {

/// What the database's bridge text says. Throws InputError if it is no bridge file.
BridgeDescription description_of(const Database& database);

/// The nominal bridge, with the blocks, mesh, joints and control points that stand in the database and the
/// material that its bridge text states; its supports and symmetry are found anew. Throws InputError if the
/// text is no bridge file.
Model bridge_of(const Database& database);

/// A row's solutions in the states of a plan; nothing for states that the database does not keep.
SceneStates stored_states(const Database& database, std::size_t row, const StatePlan& plan);

}  // namespace voussoir
