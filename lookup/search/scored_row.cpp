#include "lookup/search/scored_row.h"

#include <algorithm>
#include <cmath>

namespace voussoir {

std::vector<ScoredRow> best_rows(std::vector<ScoredRow> scored, std::size_t count) {
  std::erase_if(scored, [](const ScoredRow& row) { return !std::isfinite(row.sum); });
  const std::size_t kept = std::min(count, scored.size());
  std::partial_sort(scored.begin(), scored.begin() + static_cast<std::ptrdiff_t>(kept), scored.end());
  scored.resize(kept);
  return scored;
}

}  // namespace voussoir
