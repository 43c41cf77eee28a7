#include "lookup/preparation.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.h"
#include "lookup/search/exhaustive_search.h"

namespace voussoir {
namespace {

/// Of these numbers of missing blocks those of which there is a scene with an answer, or none.
std::vector<int> numbers_with(const SceneTable& table, const std::vector<int>& numbers, bool solved) {
  const Eligible eligible = eligible_rows(table, numbers);
  std::vector<int> found;
  for (const int missing : numbers) {
    const auto number = static_cast<std::size_t>(missing);
    if ((number < eligible.scenes.size() && eligible.scenes[number] > 0) == solved) found.push_back(missing);
  }
  return found;
}

/// `stated`: the numbers of missing blocks that somebody asks for, empty for all that there are.
Eligible eligible_or_failure(const SceneTable& table, const Prior& prior, const std::vector<int>& stated) {
  const std::vector<int> lacking = numbers_with(table, prior.missing, false);
  if (lacking.empty()) return eligible_rows(table, prior.missing);
  if (stated.empty())
    throw Failure(fmt::format("the database has no answer for any scene with {} missing blocks",
                              fmt::join(lacking, ", ")));
  throw InputError(fmt::format(
      "--missing: the database has no solved scene with {} missing blocks, expected of {}",
      fmt::join(lacking, ", "), fmt::join(numbers_with(table, numbers_of_missing(table), true), ", ")));
}

}  // namespace

Preparation::Preparation(const Library& library, const LookupSettings& settings, bool known)
    : table_(library.table),
      points_(library.points),
      prior_(stated_prior(settings.prior, table_, known)),
      eligible_(eligible_or_failure(table_, prior_, settings.prior.missing)),
      index_(library.index) {}

const EvidenceScreen& Preparation::screen() const {
  const std::scoped_lock lock(making_);
  if (!screen_) screen_.emplace(table_, index_, eligible_, prior_);
  return *screen_;
}

std::vector<ScoredRow> Preparation::smallest_misfits(const Observation& observation,
                                                     std::size_t count) const {
  if (index_.clusters() == 0)
    return exhaustive_search(observation.displacement, table_, eligible_.rows, count);
  {
    const std::scoped_lock lock(making_);
    if (!indexed_) indexed_.emplace(table_, index_, points_, eligible_);
  }
  return indexed_->search(observation.displacement, count).best;
}

}  // namespace voussoir
