#pragma once
/// @file The search index of a state: rows of control displacements in clusters of rows that are alike, each
/// cluster as a box and each row as a few bytes. It follows from control/vertical_displacement and says
/// nothing new; searches look at it first and read only the rows that it cannot rule out.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace voussoir {

inline constexpr std::size_t kIndexPlaces = 16;        ///< points are filled up to a whole number of these
inline constexpr std::int32_t kFarthestPlace = 16000;  ///< the largest size of a whole number in a box

/// The points, filled up.
constexpr std::size_t places_for(std::size_t points) {
  return (points + kIndexPlaces - 1) / kIndexPlaces * kIndexPlaces;
}

/// What is known of a row beside its sketch; four numbers in two to be near each other.
struct SlotBounds {
  std::uint32_t distance_and_step;  ///< in the lower and upper 16 bits
  std::int32_t start;

  std::int32_t distance() const { return static_cast<std::int32_t>(distance_and_step & 0xFFFFU); }
  std::int32_t step() const { return static_cast<std::int32_t>(distance_and_step >> 16U); }
};

/// Displacements are whole numbers of a cluster's unit, 2^exponent metres, here and below. With a cluster's
/// centre m, a row r of it and what is stored of the row, at each point that the row has,
///     least <= r <= most,  sum |r - m| <= distance 2^coarseness,
///     r = m + step sketch + e,  sum |e| <= lost,  start = lost - step (sum of the sketch).
/// All rounded to the safe side, so that searches may rule rows out by them.
struct SearchIndex {
  std::size_t places = 0;  ///< points, filled up

  // One or `places` values for each cluster; clusters in ascending order of their exponents.
  std::span<const std::int32_t> exponent;
  std::span<const std::int32_t> coarseness;
  std::span<const std::int32_t> first;  ///< of each cluster's slots, and one past the last slot
  std::span<const std::int16_t> centre;
  std::span<const std::int16_t> least;
  std::span<const std::int16_t> most;

  // One or `places` values for each slot; a cluster's rows in descending order of their distance.
  std::span<const std::int32_t> row;  ///< of the table, each row that has displacements once
  std::span<const SlotBounds> bounds;
  std::span<const std::int8_t> sketch;

  std::size_t clusters() const { return exponent.size(); }
  std::size_t slot(std::size_t cluster) const { return static_cast<std::size_t>(first[cluster]); }
  std::size_t rows(std::size_t cluster) const { return slot(cluster + 1) - slot(cluster); }
};

/// The same with its own memory.
struct SearchIndexData {
  std::size_t places = 0;
  std::vector<std::int32_t> exponent, coarseness, first;
  std::vector<std::int16_t> centre, least, most;
  std::vector<std::int32_t> row;
  std::vector<SlotBounds> bounds;
  std::vector<std::int8_t> sketch;

  SearchIndex view() const {
    return {places, exponent, coarseness, first, centre, least, most, row, bounds, sketch};
  }
};

}  // namespace voussoir
