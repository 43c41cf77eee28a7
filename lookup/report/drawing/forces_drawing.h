#pragma once
/// @file Pictures of what the bridge carries: stresses in blocks, joints, thrust lines.

#include <span>

#include "core/statics/stresses.h"
#include "core/statics/thrust_line.h"
#include "lookup/report/drawing/svg.h"

namespace voussoir {

/// What the pictures are of; references into a database.
struct ForcesPicture {
  const BlockLayout& layout;
  const Mesh& mesh;
  Scene scene;
  std::string heading;    ///< written above the bridge
  double width = 1040.0;  ///< units of the frame
};

/// Blocks at rest, triangles coloured by Tresca stress, and a colour bar in MPa.
Drawing draw_stresses(const ForcesPicture& picture, std::span<const TriangleStress> triangles);

/// Blocks at rest; every joint as a line as thick as its pressure, open, sliding and sticking ones in colours
/// of their own; the thrust line of every ring.
Drawing draw_joints(const ForcesPicture& picture, std::span<const JointForces> joints,
                    std::span<const ThrustPoint> thrust);

/// Blocks as outlines, those of rings as stone; every ring's middle third and thrust line.
Drawing draw_thrust(const ForcesPicture& picture, std::span<const ThrustPoint> thrust);

}  // namespace voussoir
