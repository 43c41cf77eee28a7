#include "lookup/search/eligible_rows.h"

#include <algorithm>
#include <ranges>

namespace voussoir {

int missing_blocks(const SceneTable& table, std::size_t row) {
  const auto removed = table.removed.subspan(row * table.most_missing, table.most_missing);
  return static_cast<int>(
      std::count_if(removed.begin(), removed.end(), [](std::int32_t id) { return id >= 0; }));
}

/// Scenes with few missing blocks come first.
std::vector<int> numbers_of_missing(const SceneTable& table) {
  std::vector<int> numbers;
  for (std::size_t row = 0; row < table.rows;) {
    numbers.push_back(missing_blocks(table, row));
    const auto behind = std::views::iota(row, table.rows);
    row = *std::ranges::partition_point(
        behind, [&](std::size_t later) { return missing_blocks(table, later) == numbers.back(); });
  }
  return numbers;
}

Eligible eligible_rows(const SceneTable& table, const std::vector<int>& missing) {
  Eligible result;
  result.scenes.assign(table.most_missing + 1, 0.0);
  result.standing = result.scenes;
  result.fallen.assign(table.most_missing + 1, 0);
  std::vector<bool> wanted(table.most_missing + 1, false);
  for (const int number : missing)
    if (number >= 0 && static_cast<std::size_t>(number) < wanted.size())
      wanted[static_cast<std::size_t>(number)] = true;
  for (std::size_t row = 0; row < table.rows; ++row) {
    const int lost = missing_blocks(table, row);
    if (!wanted[static_cast<std::size_t>(lost)]) continue;
    if (!table.has_answer(row)) {
      ++result.unresolved;
      continue;
    }
    if (!table.may_stand(row) && !table.has_displacements(row)) {
      ++result.fallen[static_cast<std::size_t>(lost)];
      continue;
    }
    result.rows.push_back(row);
    result.missing.push_back(static_cast<std::uint8_t>(lost));
    result.scenes[static_cast<std::size_t>(lost)] += table.weight(row);
    if (table.may_stand(row)) result.standing[static_cast<std::size_t>(lost)] += table.weight(row);
  }
  return result;
}

}  // namespace voussoir
