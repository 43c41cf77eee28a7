#pragma once
/// @file Displacements as CSV, JSON, VTK's XML and SVG.

#include <string>
#include <vector>

#include "lookup/report/field_query.h"

namespace voussoir {

enum class FieldFormat { csv, json, vtu, svg };

/// point,ux_m,uy_m; nothing where there is no value.
std::string places_csv(const std::vector<PlaceDisplacement>& places);

/// [{"point": "T12", "ux_m": .., "uy_m": ..}, ..]; null where there is no value.
std::string places_json(const std::vector<PlaceDisplacement>& places);

/// Every node of the blocks that are there. Formats: a CSV or JSON list with block, place [m] and
/// displacement [m], an unstructured grid for ParaView with the displacement at nodes, and course and
/// position of the block in triangles, or a picture of the deformed bridge.
std::string field_report(const Database& database, std::size_t row, std::size_t state, FieldFormat format);

}  // namespace voussoir
