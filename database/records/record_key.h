#pragma once
/// @file What a record is found by, and the order of records.

#include <algorithm>
#include <compare>
#include <cstdint>

#include "core/structure/scene.h"

namespace voussoir {

/// The variant of a bridge as its file states it; the others have the same structure and other parameters.
inline constexpr std::int32_t kNominalVariant = 0;

/// The one order of rows: by variant, then scenes with few removed blocks first, then lexicographic in block
/// numbers. Removed blocks are a range of ids or of their numbers, ascending.
template <class First, class Second>
std::strong_ordering row_order(std::int32_t first_variant, const First& first_removed,
                               std::int32_t second_variant, const Second& second_removed) {
  if (const auto order = first_variant <=> second_variant; order != 0) return order;
  if (const auto order = first_removed.size() <=> second_removed.size(); order != 0) return order;
  return std::lexicographical_compare_three_way(
      first_removed.begin(), first_removed.end(), second_removed.begin(), second_removed.end(),
      [](auto first, auto second) {
        return static_cast<std::int32_t>(first) <=> static_cast<std::int32_t>(second);
      });
}

struct RecordKey {
  std::int32_t variant = kNominalVariant;
  Scene scene;

  friend bool operator==(const RecordKey&, const RecordKey&) = default;
  friend std::strong_ordering operator<=>(const RecordKey& first, const RecordKey& second) {
    return row_order(first.variant, first.scene.removed, second.variant, second.scene.removed);
  }
};

/// The keys of these scenes in one variant.
std::vector<RecordKey> keys_of(std::int32_t variant, const std::vector<Scene>& scenes);

/// "10,4" for the nominal variant, "10,4 of variant 3" for others.
std::string to_string(const RecordKey& key, const BlockLayout& layout);

}  // namespace voussoir
