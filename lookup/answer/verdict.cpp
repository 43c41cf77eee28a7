#include "lookup/answer/verdict.h"

#include <algorithm>
#include <functional>

namespace voussoir {

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

Verdict verdict_by_probability(const Posterior& posterior, bool explained) {
  if (!explained || posterior.credible.empty()) return Verdict::unexplained;
  const double intact = intact_probability(posterior);
  if (intact >= kCertain)
    return posterior.intact_if_even >= kCertain ? Verdict::intact : Verdict::cannot_tell;
  const auto& blocks = posterior.block_probability;
  if (std::any_of(blocks.begin(), blocks.end(), [](double share) { return share >= kCertain; }))
    return Verdict::located;
  return 1.0 - intact >= kCertain ? Verdict::damaged_unlocated : Verdict::cannot_tell;
}

Supposed supposed_by(const Prior& prior) {
  const std::vector<double> weight = weights_of(prior);
  bool none = false, some = false;
  for (std::size_t i = 0; i < weight.size(); ++i)
    if (weight[i] > 0.0) (prior.missing[i] == 0 ? none : some) = true;
  return none == some ? Supposed::nothing : some ? Supposed::damage : Supposed::no_damage;
}

Verdict verdict_of(const Answer& answer) {
  const Verdict alone = verdict_by_probability(*answer.posterior, answer.fit && answer.fit->explained);
  if (alone == Verdict::unexplained) return alone;
  const bool as_supposed = supposed_by(answer.prior) != Supposed::nothing && alone != Verdict::located;
  return answer.contested || as_supposed ? Verdict::cannot_tell : alone;
}

bool is_intact_by_belief(const Answer& answer) {
  const bool is_asked = !answer.contested && supposed_by(answer.prior) == Supposed::nothing;
  return is_asked && verdict_of(answer) == Verdict::cannot_tell &&
         intact_probability(*answer.posterior) >= kCertain;
}

std::vector<BlockId> named_blocks(const Answer& answer) {
  if (!answer.posterior || verdict_of(answer) != Verdict::located) return {};
  return likely_blocks(*answer.posterior, kCertain);
}

std::vector<OpenLoss> open_losses(const Answer& answer) {
  if (!answer.posterior || verdict_of(answer) != Verdict::intact) return {};
  std::vector<OpenLoss> open = answer.posterior->open_losses;
  std::ranges::stable_sort(open, std::ranges::greater{}, &OpenLoss::times_as_likely);
  return open;
}

bool has_probabilities(const Answer& answer) {
  return answer.posterior && verdict_of(answer) != Verdict::unexplained;
}

}  // namespace voussoir
