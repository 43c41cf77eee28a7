#include "lookup/unknown/screened_cases.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/threads.h"
#include "lookup/evidence/largest_places.h"
#include "lookup/search/eligible_rows.h"
#include "lookup/unknown/likely_places.h"

namespace voussoir {
namespace {

constexpr double kNotWorkedOut = std::numeric_limits<double>::infinity();
constexpr double kNoEstimate = std::numeric_limits<double>::infinity();
/// Logarithms of how far behind the likeliest a scene's case is left out, and a scene may be left for what
/// all of them sum up to: an estimate is too low by more in one question of thousands.
constexpr double kNegligibleCase = 20.0, kNegligibleScene = 15.0;
// Probabilities of all scenes together that are left, by estimates that are too high: in cases where none of
// them matters; with a look in a few directions; in some; of those that are no candidates for being worked
// out; and of all that are not worked out.
constexpr double kUncounted = 3e-4, kLeftWithFew = 2e-4, kLeftUnrefined = 4e-4, kLeftUnordered = 5e-4,
                 kLeftEstimated = 1e-3;
/// Likely scenes that are looked at in all directions; the others once so many have been worked out that it
/// is cheaper than to go on.
constexpr std::size_t kFirstRefined = 64000, kBeforeOthers = 2000;
constexpr double kCaseTooLow = 0.5;  // what an estimate's logarithm may be too low by at least
constexpr std::size_t kAtOnce = 8;   // scenes that are worked out before the next look at what matters
constexpr std::size_t kMostWorkedOut = 400;  // likely scenes; others count by their estimates
static_assert(kBeforeOthers % kAtOnce == 0);
constexpr std::size_t kTried = 4;  // scenes with which a case is tried before pairs are looked at

}  // namespace

ScreenedCases::ScreenedCases(const UnknownBridge& bridge, const Observation& observation,
                             const SceneTable& table, std::span<const UnknownCase> cases,
                             std::span<const std::size_t> rows, std::span<const double> beforehand)
    : bridge_(bridge),
      observation_(observation),
      table_(table),
      rows_(rows),
      beforehand_(beforehand),
      estimates_(bridge, observation, table, cases, rows, beforehand),
      likelihoods_(bridge, observation, table),
      too_low_(kCaseTooLow),
      is_refined_(rows.size(), false),
      is_worked_out_(rows.size(), false) {
  many_.reserve(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool few = table.most_missing < 2 || table.removed[rows[i] * table.most_missing + 1] < 0;
    (few ? few_ : many_).push_back(i);
  }
  terms_ = case_terms(bridge, observation, cases);
}

/// The intact bridge, and singles whose signals are nearest to the readings: something to try cases with.
std::vector<std::size_t> ScreenedCases::nearest_singles() const {
  std::vector<std::pair<double, std::size_t>> distances;
  for (const std::size_t place : few_) {
    const auto loss = scene_loss(bridge_, observation_, table_, rows_[place]);
    if (loss) distances.emplace_back((bridge_.reading - loss->signal).squaredNorm(), place);
  }
  std::sort(distances.begin(), distances.end());
  std::vector<std::size_t> places;
  for (const auto& [distance, place] : distances)
    if (places.size() < kTried || table_.removed[rows_[place] * table_.most_missing] < 0)
      places.push_back(place);
  return places;
}

/// Below it all scenes in all cases do not matter together.
double ScreenedCases::least_counted() const {
  return best_ - too_low_ + std::log(kUncounted / static_cast<double>(estimates_.count()));
}

/// Of these cases and the scenes that were worked out in them the likeliest's: all that are as likely leave
/// much the same of the readings.
Eigen::MatrixXd ScreenedCases::pull_of_likeliest(std::size_t first, std::size_t end) {
  double best = kImpossible;
  std::size_t likeliest = 0, in = 0;
  for (const auto& [place, exact] : exact_)
    for (std::size_t k = first; k < end; ++k)
      if (exact[k] != kNotWorkedOut && exact[k] + beforehand_[place] > best)
        best = exact[k] + beforehand_[place], likeliest = place, in = k;
  if (best == kImpossible) return {};
  return likelihoods_.pull(terms_[in], rows_[likeliest]);
}

/// Cases of one level: first the scenes with few missing blocks, which show how likely scenes are.
void ScreenedCases::look_at_level() {
  const auto [first, end] = estimates_.next_level();
  estimates_.look_at_next(pull_of_likeliest(first, end));
  estimates_.estimate(few_, kImpossible);
  estimates_.refine(few_, first, ScreenDirections::more, kImpossible);
  for (std::size_t number = first; number < estimates_.looked_at(); ++number) try_case(number);
  look_at_many(first);
}

/// Works out the scenes with few missing blocks that seem the likeliest in a case.
void ScreenedCases::try_case(std::size_t number) {
  std::vector<double> estimates;
  for (const std::size_t place : few_) estimates.push_back(estimates_.of(place, number));
  std::vector<std::size_t> places;
  for (const std::size_t i : largest_places(estimates, kTried))
    if (estimates[i] > kImpossible) places.push_back(few_[i]);
  work_out(places, [&](std::size_t, std::size_t k) { return k == number; });
  for (const std::size_t place : few_)
    if (exact_.contains(place)) check_estimate(place, number);
}

/// Scenes with many missing blocks are looked at no better than they have to be; the likeliest of them are
/// worked out to know how well that is.
void ScreenedCases::look_at_many(std::size_t first) {
  const std::vector<double>& sums = estimates_.sums();
  estimates_.estimate(many_, least_counted());
  std::vector<std::size_t> places = that_matter(many_, kLeftWithFew);
  work_out(largest_places(places, sums, kAtOnce), [&](std::size_t place, std::size_t number) {
    return number < estimates_.looked_at() && may_matter(place, number);
  });
  places = that_matter(places, kLeftWithFew);
  estimates_.refine(places, first, ScreenDirections::more, least_counted());
}

/// log of what the estimates of scenes with so much of the probability sum up to, if they are too low.
double ScreenedCases::sum_of(double probability) const {
  return best_ - too_low_ + std::log(probability);
}

/// Without those that hold less than `rest` together.
std::vector<std::size_t> ScreenedCases::that_matter(std::span<const std::size_t> places, double rest) const {
  return likely_places(places, estimates_.sums(), sum_of(rest), best_ - too_low_ - kNegligibleScene);
}
std::vector<std::size_t> ScreenedCases::that_matter(double rest) const {
  return likely_places(estimates_.sums(), sum_of(rest), best_ - too_low_ - kNegligibleScene);
}

/// Of a scene that was worked out in a case, if it is likely: how much its estimate is too low.
void ScreenedCases::check_estimate(std::size_t place, std::size_t number) {
  const double log = exact_.at(place)[number] + beforehand_[place];
  if (number < estimates_.looked_at() && log != kNotWorkedOut && log > best_ - kNegligibleCase)
    too_low_ = std::max(too_low_, log - estimates_.of(place, number));
}

/// In the cases that are wanted of each place, by their numbers, those worked out before left out.
void ScreenedCases::work_out(std::span<const std::size_t> places, const WantedCase& is_wanted,
                             const Eigen::MatrixXd* rise) {
  std::vector<std::size_t> rows;
  std::vector<std::uint8_t> missing;
  CasePruning pruning;
  std::vector<double> least;
  for (const std::size_t place : places)
    least.push_back(best_ - too_low_ - kNegligibleCase - beforehand_[place]);
  if (rise != nullptr) pruning = {least, *rise};
  for (const std::size_t place : places) {
    rows.push_back(rows_[place]);
    std::vector<double>& exact = exact_[place];
    exact.resize(terms_.size(), kNotWorkedOut);
    for (std::size_t k = 0; k < terms_.size(); ++k)
      missing.push_back(is_wanted(place, k) && exact[k] == kNotWorkedOut);
  }
  const auto logs =
      likelihoods_(terms_, rows, missing, hardware_threads(), rise != nullptr ? &pruning : nullptr);
  for (std::size_t i = 0; i < logs.size(); ++i) {
    if (missing[i] == 0) continue;
    const std::size_t place = places[i / terms_.size()], number = i % terms_.size();
    exact_[place][number] = over_scatter(logs[i]);
    const double log = exact_[place][number] + beforehand_[place];
    if (log > best_) best_ = log, likeliest_ = number;
    check_estimate(place, number);
  }
}

/// Beside the likeliest scene's.
bool ScreenedCases::may_matter(std::size_t place, std::size_t number) const {
  return !(estimates_.of(place, number) + too_low_ < best_ - kNegligibleCase);
}

/// In all cases that may matter.
void ScreenedCases::work_out_where_likely(std::span<const std::size_t> places) {
  for (const std::size_t place : places) is_worked_out_[place] = true;
  work_out(
      places, [&](std::size_t place, std::size_t number) { return may_matter(place, number); },
      &estimates_.rises());
}

/// log of the sum over the cases in which the place was worked out.
double ScreenedCases::total(std::size_t place) const {
  double sum = kImpossible;
  for (const double one : exact_.at(place))
    if (one != kNotWorkedOut) sum = log_sum(sum, one);
  return sum;
}

/// Tries all cases with a few scenes, then looks at those of each level.
void ScreenedCases::look_at_cases() {
  work_out(nearest_singles(), [](std::size_t, std::size_t) { return true; });
  while (estimates_.looked_at() < terms_.size()) look_at_level();
}

/// Looks at likely scenes in all directions, as far as what is left matters.
void ScreenedCases::refine_likely() {
  const std::vector<double>& sums = estimates_.sums();
  std::vector<std::size_t> likely = that_matter(kLeftUnrefined);
  work_out_where_likely(largest_places(likely, sums, kAtOnce));
  likely = that_matter(likely, kLeftUnrefined);
  if (likely.size() > kFirstRefined) {
    std::nth_element(likely.begin(), likely.begin() + kFirstRefined, likely.end(),
                     [&](std::size_t a, std::size_t b) { return sums[a] > sums[b]; });
    likely.resize(kFirstRefined);
  }
  refine(likely);
}

/// In all directions.
void ScreenedCases::refine(std::span<const std::size_t> places) {
  estimates_.refine(places, 0, ScreenDirections::all, best_ - too_low_ - kNegligibleCase);
  for (const std::size_t place : places) {
    is_refined_[place] = true;
    if (const auto exact = exact_.find(place); exact != exact_.end())
      for (std::size_t number = 0; number < exact->second.size(); ++number) check_estimate(place, number);
  }
}

/// All scenes that may count, and at least so many.
std::vector<std::size_t> ScreenedCases::candidates(std::size_t count) const {
  std::vector<std::size_t> places = that_matter(kLeftUnordered);
  if (places.size() < count) places = largest_places(estimates_.sums(), count);
  return places;
}

/// Scenes that were tried in some case, and those without an estimate.
std::vector<std::size_t> ScreenedCases::known_to_need_it() const {
  std::vector<std::size_t> places;
  for (const auto& [place, exact] : exact_) places.push_back(place);
  for (std::size_t place = 0; place < rows_.size(); ++place)
    if (estimates_.sums()[place] == kNoEstimate && !exact_.contains(place)) places.push_back(place);
  return places;
}

/// Scenes that may count and are not worked out. Those of one kind lack as many blocks, each of whose losses
/// is known; all others, such as those with factors of their own, are kOther.
LeftScenes ScreenedCases::left_scenes(std::size_t count) const {
  std::vector<std::size_t> places = candidates(count);
  std::erase_if(places, [&](std::size_t place) { return is_worked_out_[place]; });
  return {std::move(places), estimates_.sums(), [this](std::size_t place) {
            const auto missing = static_cast<std::size_t>(missing_blocks(table_, rows_[place]));
            const bool all_known = known_losses(bridge_, table_, rows_[place]).count == missing;
            return all_known && missing < LeftScenes::kOther ? missing : LeftScenes::kOther;
          }};
}

/// Of those that are left.
void ScreenedCases::refine_others(LeftScenes& left) {
  std::vector<std::size_t> others;
  for (const std::size_t place : left.places())
    if (!is_refined_[place]) others.push_back(place);
  refine(others);
  left.order_again();
}

/// Works out scenes in the order of their estimates, so many at a time, until what is left can change no
/// probability by more than kLeftEstimated, or more are likely indeed than can be worked out.
void ScreenedCases::work_out_likely(std::size_t count, LeftScenes& left) {
  std::size_t likely = 0;
  for (std::size_t done = 0; !left.empty(); done += kAtOnce) {
    const bool enough = left.log_sum() < sum_of(kLeftEstimated - kLeftUnordered);
    if (done >= count && (enough || likely >= kMostWorkedOut)) break;
    if (done == kBeforeOthers) refine_others(left);
    const std::vector<std::size_t> some = left.next(kAtOnce);
    work_out_where_likely(some);
    for (const std::size_t place : some) {
      const double log = total(place) + beforehand_[place];
      left.learn(place, log);
      if (log > best_ + std::log(kLeftEstimated / kMostWorkedOut)) ++likely;
    }
  }
}

std::vector<PlaceLog> ScreenedCases::evidence(std::size_t count) {
  count = std::max(count, kAtOnce);
  look_at_cases();
  refine_likely();
  work_out_where_likely(known_to_need_it());
  LeftScenes left = left_scenes(count);
  work_out_likely(count, left);
  std::vector<PlaceLog> result = left.corrected();
  for (auto& [place, log] : result) log -= beforehand_[place];
  for (const auto& [place, exact] : exact_)
    if (is_worked_out_[place]) result.push_back({place, total(place)});
  std::sort(result.begin(), result.end(), [](const auto& a, const auto& b) { return a.place < b.place; });
  const double log_cases = std::log(static_cast<double>(terms_.size()));
  for (auto& [place, log] : result) log -= log_cases;
  return result;
}

}  // namespace voussoir
