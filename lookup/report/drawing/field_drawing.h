#pragma once
/// @file Pictures of displacement fields: the deformed bridge, its settlement in colour.

#include <string>

#include "core/structure/mesh.h"
#include "core/structure/scene.h"
#include "lookup/report/drawing/svg.h"

namespace voussoir {

/// A scene's displacements with what they belong to; references into a database.
struct FieldPicture {
  const BlockLayout& layout;
  const Mesh& mesh;
  Scene scene;
  Field field;            ///< [m] NaN at nodes of missing blocks
  std::string heading;    ///< written above the bridge, before the scale; may be empty
  double width = 1040.0;  ///< units of the frame
};

/// Blocks where they have moved to, coloured by vertical displacement (linear within each triangle, as the
/// model has it; colours in equal bands between the smallest and the largest), missing blocks as dashed
/// outlines where they were, and a colour bar in millimetres. The heading states the exaggeration.
Drawing draw_field(const FieldPicture& picture);

}  // namespace voussoir
