#pragma once
/// @file What searches look at: one row of numbers for each scene.

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

#include "core/statics/solution.h"
#include "core/structure/scene.h"

namespace voussoir {

/// The scenes of one variant in one state, few removed blocks first, then lexicographic: what a search over
/// the whole database needs, as views into the database's memory. Views live as long as the Database they
/// come from.
struct SceneTable {
  std::size_t rows = 0;              ///< scenes
  std::size_t points = 0;            ///< control points
  std::size_t most_missing = 0;      ///< columns of `removed`
  std::span<const double> vertical;  ///< rows x points [m], up is positive, NaN where the block is gone; of
                                     ///< scenes of which only the outcome is known all NaN
  std::span<const std::int32_t> removed;     ///< rows x most_missing, block ids in ascending order, then -1
  std::span<const std::uint8_t> outcome;     ///< values of Outcome
  std::span<const std::uint8_t> collapse{};  ///< values of CollapseExtent
  std::span<const std::uint8_t> origin{};    ///< values of Origin; empty: all are solved
  std::size_t first_record = 0;              ///< the database's row of row 0: 0 for the nominal variant
  /// Of scenes that fall in the nominal bridge, but stand in some of those drawn at random, the share of
  /// these, of others 0. Empty: the bridge is just as its file says.
  std::span<const double> standing_share{};

  std::span<const double> row(std::size_t scene) const { return vertical.subspan(scene * points, points); }
  bool stands(std::size_t scene) const;
  /// Does it fall, but stand in some bridges?
  bool is_uncertain_fall(std::size_t scene) const {
    return !standing_share.empty() && standing_share[scene] > 0.0;
  }
  bool may_stand(std::size_t scene) const { return stands(scene) || is_uncertain_fall(scene); }
  /// Is it known how it ends, or how it would if it stood?
  bool has_answer(std::size_t scene) const {
    return outcome[scene] != static_cast<std::uint8_t>(Outcome::unresolved) || is_uncertain_fall(scene);
  }
  /// How many scenes it counts for beforehand, among those that may be read; and the logarithm of that.
  double weight(std::size_t scene) const { return is_uncertain_fall(scene) ? standing_share[scene] : 1.0; }
  double log_weight(std::size_t scene) const {
    return is_uncertain_fall(scene) ? std::log(standing_share[scene]) : 0.0;
  }
  bool has_displacements(std::size_t scene) const;  ///< at any control point
  Origin origin_of(std::size_t scene) const {
    return origin.empty() ? Origin::solved : static_cast<Origin>(origin[scene]);
  }
  Scene scene(std::size_t row) const;
  std::optional<std::size_t> find(const Scene& scene) const;  ///< its row, by bisection
};

/// A table of nothing but one row of numbers.
inline SceneTable table_of_one_row(std::span<const double> row) {
  SceneTable table;
  table.rows = 1;
  table.points = row.size();
  table.vertical = row;
  return table;
}

}  // namespace voussoir
