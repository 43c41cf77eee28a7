#pragma once
/// @file What the database keeps of one scene in one variant of the bridge.

#include <vector>

#include "core/statics/solution.h"
#include "core/structure/control_point.h"
#include "database/format/sha256.h"
#include "database/records/record_key.h"

namespace voussoir {

/// What a solver found at the end of one stage of the scene's history.
struct RecordedState {
  Outcome outcome = Outcome::unresolved;
  double residual = 0.0;                         ///< as in Solution [-]
  std::int32_t iterations = 0;                   ///< as in Solution
  CollapseExtent extent = CollapseExtent::none;  ///< as in Solution
  std::vector<BlockId> moving;                   ///< as in Solution
  std::vector<double> vertical;                  ///< [m] at the control points, NaN where the block is gone
  Origin origin = Origin::solved;                ///< as in Solution
  std::vector<double> slipped;  ///< as in Solution, joint after joint; empty: nothing, or fields are not kept
  Bytes packed_field;           ///< pack_field of the displacements; empty if fields are not kept
  std::uint32_t field_crc = 0;  ///< CRC-32 of packed_field
};

struct Record {
  RecordKey key;
  std::vector<RecordedState> states;  ///< one for each state of the database
  Sha256 checksum{};                  ///< scene_checksum of all of the above
};

enum class KeepField { no, yes };

/// The record of a solved scene, a solution for each state. Precondition: the fields have been rounded by
/// to_storage_precision. With `in_checksum` no, fields are packed but not part of the checksum (they serve as
/// starts for other scenes and will not be in the database).
Record make_record(const RecordKey& key, std::span<const Solution> states,
                   const std::vector<ControlPoint>& points, KeepField keep, KeepField in_checksum);

/// The solution that a state was made of, given its field.
Solution solution_of(const RecordedState& state, Field displacement);

/// The numbers of a field, node after node.
inline std::span<const double> numbers_of(const Field& field) {
  return {field.data(), static_cast<std::size_t>(field.size())};
}

/// SHA-256 over, little-endian and without gaps: the number of states (uint32); for each column of the record
/// and then, state after state, for each column of a state, as far as they are in the checksum and in their
/// order (database/records/columns.h): the number of values (uint32) and the values; optional columns of
/// which the value is zero are left out. `fields` are those of the states, or empty if the database keeps
/// none: they count as columns without values.
Sha256 scene_checksum(const Record& record, std::span<const std::span<const double>> fields);

}  // namespace voussoir
