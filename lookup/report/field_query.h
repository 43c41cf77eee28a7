#pragma once
/// @file The displacement of a scene at chosen places.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "database/records/database.h"

namespace voussoir {

/// A place and its displacement there.
struct PlaceDisplacement {
  std::string name;    ///< of the control point, or "x,y" as it was asked for
  Point displacement;  ///< [m] (u_x, u_y); NaN where the block is gone, and u_x in a database without fields
  Point position;      ///< [m] on the drawing
};

/// The number of the state of a history ("built", "lost"; nothing: that of the first state) without or with a
/// load case or its stage ("truck", "truck@2"). Throws InputError for a state that the database lacks, naming
/// those that it has.
std::size_t find_state(const Database& database, const std::optional<std::string>& history,
                       const std::optional<std::string>& load);

/// The row of a scene. Throws InputError for text that is no scene, Failure for a scene that the database
/// lacks.
std::size_t find_row(const Database& database, std::string_view scene);

/// Throws Failure if the scene falls in a state and the database keeps only that.
void expect_displacements(const Database& database, std::size_t row, std::size_t state);

/// `at` is "control" (all control points and the bridge file's sensors of ux and uy), names of such as
/// "T12,A3", or coordinates "X,Y" in metres, where the displacement is interpolated within the triangle that
/// holds the place. Throws InputError for unknown points, sensors of a tilt or a distance and places outside
/// the scene's blocks, Failure for coordinates in a database without fields.
std::vector<PlaceDisplacement> displacements_at(const Database& database, std::size_t row, std::size_t state,
                                                std::string_view at);

}  // namespace voussoir
