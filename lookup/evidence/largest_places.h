#pragma once
/// @file Where the largest of some values are.

#include <algorithm>
#include <numeric>
#include <span>
#include <vector>

namespace voussoir {

/// Of these places the `count` with the largest values (or all, if they are fewer), the largest first, equal
/// ones in the order of places.
inline std::vector<std::size_t> largest_places(std::vector<std::size_t> places,
                                               std::span<const double> values, std::size_t count) {
  count = std::min(count, places.size());
  std::partial_sort(
      places.begin(), places.begin() + static_cast<std::ptrdiff_t>(count), places.end(),
      [&](std::size_t a, std::size_t b) { return values[a] != values[b] ? values[a] > values[b] : a < b; });
  places.resize(count);
  return places;
}

/// The same of all places.
inline std::vector<std::size_t> largest_places(std::span<const double> values, std::size_t count) {
  std::vector<std::size_t> places(values.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  return largest_places(std::move(places), values, count);
}

}  // namespace voussoir
