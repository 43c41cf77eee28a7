#pragma once
/// @file What the database keeps of one scene.

#include <vector>

#include "core/statics/solution.h"
#include "core/structure/control_point.h"
#include "core/structure/scene.h"
#include "database/format/sha256.h"

namespace voussoir {

/// The number of the bridge's variant that a record belongs to. There is one so far; files have room for
/// more.
inline constexpr std::int32_t kOnlyVariant = 0;

struct Record {
  Scene scene;
  Outcome outcome = Outcome::unresolved;
  double residual = 0.0;                         ///< as in Solution [-]
  std::int32_t iterations = 0;                   ///< as in Solution
  CollapseExtent extent = CollapseExtent::none;  ///< as in Solution
  std::vector<BlockId> moving;                   ///< as in Solution
  std::vector<double> vertical;                  ///< [m] at the control points, NaN where the block is gone
  Bytes packed_field;  ///< pack_field of the displacements; empty if fields are not kept
  Sha256 checksum{};   ///< scene_checksum of all of the above
};

enum class KeepField { no, yes };

/// The record of a solved scene. Precondition: the solution's field has been rounded by to_storage_precision.
/// With `in_checksum` no, the field is packed but not part of the checksum (it serves as a start for other
/// scenes and will not be in the database).
Record make_record(const Scene& scene, const Solution& solution, const std::vector<ControlPoint>& points,
                   KeepField keep, KeepField in_checksum);

/// The solution that a record was made of, given its field.
Solution solution_of(const Record& record, Field displacement);

/// SHA-256 over, little-endian and without gaps: int32 variant, int32 number of removed blocks, int32 each
/// removed block, uint8 outcome, float64 residual, int32 iterations, uint8 extent of the collapse, int32
/// number of moving blocks, int32 each moving block, float64 vertical displacement of each
/// control point and, if the field is kept, float64 displacements (ux, uy) node after node.
Sha256 scene_checksum(const Record& record, std::span<const double> field);

}  // namespace voussoir
