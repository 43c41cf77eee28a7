#include "lookup/answer/preparation.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.h"
#include "lookup/search/exhaustive_search.h"

namespace voussoir {
namespace {

/// Is it known of some scene how it ends?
bool has_answers(const Eligible& eligible, int missing) {
  const auto number = static_cast<std::size_t>(missing);
  return number < eligible.scenes.size() && eligible.scenes[number] + eligible.fallen[number] > 0;
}

/// Numbers of missing blocks of which some scene has an answer.
std::vector<int> solved_numbers(const SceneTable& table) {
  std::vector<int> numbers = numbers_of_missing(table);
  const Eligible all = eligible_rows(table, numbers);
  std::erase_if(numbers, [&](int missing) { return !has_answers(all, missing); });
  return numbers;
}

/// `stated`: the numbers of missing blocks that somebody asks for, empty for all that there are.
Eligible eligible_or_failure(const SceneTable& table, const Prior& prior, const std::vector<int>& stated) {
  Eligible eligible = eligible_rows(table, prior.missing);
  std::vector<int> lacking = prior.missing;
  std::erase_if(lacking, [&](int missing) { return has_answers(eligible, missing); });
  if (lacking.empty() && !eligible.rows.empty()) return eligible;
  if (lacking.empty())
    throw Failure(fmt::format(
        "in all scenes with {} missing blocks something falls, and the database keeps only that: expected "
        "scenes that readings may be of",
        fmt::join(prior.missing, ", ")));
  if (stated.empty())
    throw Failure(fmt::format("the database has no answer for any scene with {} missing blocks",
                              fmt::join(lacking, ", ")));
  throw InputError(
      fmt::format("--missing: the database has no solved scene with {} missing blocks, expected of {}",
                  fmt::join(lacking, ", "), fmt::join(solved_numbers(table), ", ")));
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
