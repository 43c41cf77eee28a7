#pragma once
/// @file Blocks and mesh as a database file holds them.

#include "database/format/hdf5_file.h"
#include "database/records/database.h"

namespace voussoir {

/// All three throw InputError if indices, ranges or counts do not fit together.
BlockLayout read_layout(const Hdf5File& file);
Mesh read_mesh(const Hdf5File& file, std::size_t blocks);
std::vector<StoredPoint> read_control_points(const Hdf5File& file);

}  // namespace voussoir
