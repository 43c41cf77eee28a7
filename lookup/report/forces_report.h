#pragma once
/// @file Stresses, joints and thrust lines of a scene as CSV, JSON, VTK's XML and SVG.

#include "lookup/report/field_report.h"
#include "lookup/report/scene_forces.h"

namespace voussoir {

/// What query-field shows of a scene.
enum class FieldQuantity { displacements, stresses, joints, thrust };

/// Formats: a row a triangle, a joint's stretch or a joint of a ring in CSV and JSON; triangles or stretches
/// with their values in cells for ParaView (thrust lines: one cell a ring); a picture, which of joints and
/// thrust lines is the same. `quantity`: not displacements.
std::string forces_report(const Database& database, std::size_t row, std::size_t state,
                          FieldQuantity quantity, FieldFormat format);

}  // namespace voussoir
