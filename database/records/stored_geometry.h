#pragma once
/// @file Blocks, mesh, joints and control points as a database file holds them.

#include "database/format/hdf5_file.h"
#include "database/records/database.h"

namespace voussoir {

/// All of them throw InputError if indices, ranges or counts do not fit together: whoever has them may follow
/// every index, and finds a block's triangles, edges and joints on the block's own nodes.
BlockLayout read_layout(const Hdf5File& file);
Mesh read_mesh(const Hdf5File& file, std::size_t blocks);
std::vector<Joint> read_joints(const Hdf5File& file, const Mesh& mesh);
std::vector<StoredPoint> read_control_points(const Hdf5File& file);
/// What each of the points reads; none: how far its node goes up. Precondition: the points' blocks exist.
std::vector<std::vector<NodeWeight>> read_weights(const Hdf5File& file,
                                                  const std::vector<StoredPoint>& points, const Mesh& mesh);
std::vector<std::string> read_states(const Hdf5File& file);

}  // namespace voussoir
