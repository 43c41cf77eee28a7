#include "lookup/search/exhaustive_search.h"

namespace voussoir {

std::vector<ScoredRow> exhaustive_search(std::span<const double> readings, const SceneTable& table,
                                         std::span<const std::size_t> rows, std::size_t count) {
  const std::vector<double> sums = sums_of_differences(readings, table, rows);
  std::vector<ScoredRow> scored;
  scored.reserve(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) scored.push_back({rows[i], sums[i]});
  return best_rows(std::move(scored), count);
}

}  // namespace voussoir
