#include "lookup/search/eligible_rows.h"

#include <algorithm>

namespace voussoir {

int missing_blocks(const SceneTable& table, std::size_t row) {
  const auto removed = table.removed.subspan(row * table.most_missing, table.most_missing);
  return static_cast<int>(
      std::count_if(removed.begin(), removed.end(), [](std::int32_t id) { return id >= 0; }));
}

Eligible eligible_rows(const SceneTable& table, const std::vector<int>& missing) {
  Eligible result;
  result.scenes.assign(table.most_missing + 1, 0);
  std::vector<bool> wanted(table.most_missing + 1, false);
  for (const int number : missing)
    if (number >= 0 && static_cast<std::size_t>(number) < wanted.size())
      wanted[static_cast<std::size_t>(number)] = true;
  for (std::size_t row = 0; row < table.rows; ++row) {
    const int lost = missing_blocks(table, row);
    if (!wanted[static_cast<std::size_t>(lost)]) continue;
    if (table.outcome[row] == static_cast<std::uint8_t>(Outcome::unresolved)) {
      ++result.unresolved;
      continue;
    }
    result.rows.push_back(row);
    result.missing.push_back(static_cast<std::uint8_t>(lost));
    ++result.scenes[static_cast<std::size_t>(lost)];
  }
  return result;
}

}  // namespace voussoir
