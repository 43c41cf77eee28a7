#include "lookup/report/verdict.h"

#include <algorithm>

namespace voussoir {

Verdict verdict_of(const Posterior& posterior, bool explained) {
  if (!explained || posterior.credible.empty()) return Verdict::unexplained;
  const double intact = intact_probability(posterior);
  if (intact >= kCertain)
    return posterior.intact_if_even >= kCertain ? Verdict::intact : Verdict::cannot_tell;
  const auto& blocks = posterior.block_probability;
  if (std::any_of(blocks.begin(), blocks.end(), [](double share) { return share >= kCertain; }))
    return Verdict::located;
  return 1.0 - intact >= kCertain ? Verdict::damaged_unlocated : Verdict::cannot_tell;
}

std::string_view to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::located:
      return "located";
    case Verdict::damaged_unlocated:
      return "damaged-unlocated";
    case Verdict::intact:
      return "intact";
    case Verdict::cannot_tell:
      return "cannot-tell";
    default:
      return "unexplained";
  }
}

}  // namespace voussoir
