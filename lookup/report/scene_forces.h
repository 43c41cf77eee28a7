#pragma once
/// @file Stresses and joints' forces of a scene, found from the fields in a database.

#include "core/statics/stresses.h"
#include "core/statics/thrust_line.h"
#include "database/records/database.h"

namespace voussoir {

struct SceneForces {
  Scene scene;
  std::vector<TriangleStress> triangles;  ///< of each triangle of the mesh
  std::vector<JointForces> joints;
  std::vector<ThrustPoint> thrust;
};

/// What the joints remember follows from the states before; of blocks that went in several steps these are
/// solved again (milliseconds). Throws Failure without fields or for a scene that does not stand: its field
/// is a moment of motion, not an equilibrium. InputError if the database's bridge text is none.
SceneForces scene_forces(const Database& database, std::size_t row, std::size_t state);

}  // namespace voussoir
