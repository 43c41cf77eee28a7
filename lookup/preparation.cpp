#include "lookup/preparation.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.h"
#include "lookup/search/exhaustive_search.h"

namespace voussoir {
namespace {

Eligible eligible_or_failure(const SceneTable& table, const Prior& prior) {
  Eligible eligible = eligible_rows(table, prior.missing);
  std::vector<int> lacking;
  for (const int missing : prior.missing) {
    const auto number = static_cast<std::size_t>(missing);
    if (number >= eligible.scenes.size() || eligible.scenes[number] == 0) lacking.push_back(missing);
  }
  if (!lacking.empty())
    throw InputError(
        fmt::format("--missing: the database has no solved scene with {} missing blocks, expected of {}",
                    fmt::join(lacking, ", "), fmt::join(numbers_of_missing(table), ", ")));
  return eligible;
}

}  // namespace

Preparation::Preparation(const Library& library, const LookupSettings& settings, bool known)
    : table_(library.table),
      points_(library.points),
      prior_(stated_prior(settings.prior, table_, known)),
      eligible_(eligible_or_failure(table_, prior_)),
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
