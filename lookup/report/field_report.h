#pragma once
/// @file Displacements as CSV, JSON, VTK's XML and SVG.

#include <string>
#include <vector>

#include "lookup/report/field_query.h"
#include "lookup/report/vtk_grid.h"

namespace voussoir {

enum class FieldFormat { csv, json, vtu, svg };

/// point, ux_m, uy_m as CSV or JSON; nothing or null where there is no value.
std::string places_report(const std::vector<PlaceDisplacement>& places, FieldFormat format);

/// Every node of the blocks that are there. Formats: a CSV or JSON list with block, place [m] and
/// displacement [m], an unstructured grid for ParaView with the displacement at nodes, and course and
/// position of the block in triangles, or a picture of the deformed bridge.
std::string field_report(const Database& database, std::size_t row, std::size_t state, FieldFormat format);

/// The triangles of the blocks that are there with the displacement at nodes [m], and course and position of
/// the block in triangles.
VtkGrid field_grid(const Mesh& mesh, const BlockLayout& layout, const Scene& scene, const Field& field);

/// "Bridge 'reference' without 10,4 as lost, standing"
std::string scene_heading(const Database& database, std::size_t row, std::size_t state);

}  // namespace voussoir
