#include "lookup/evidence/screened_cases.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/threads.h"
#include "lookup/evidence/largest_places.h"

namespace voussoir {
namespace {

constexpr double kNotWorkedOut = std::numeric_limits<double>::infinity();
constexpr double kNegligibleCase =
    20.0;                            // logarithm of how far behind the likeliest a scene's case is left out
constexpr double kUncounted = 3e-4;  // probability of all scenes that are left at their first estimates
constexpr double kLeftEstimated = 5e-4;      // probability of all scenes that are not worked out
constexpr double kLeftUnrefined = 1e-4;      // of those that are not looked at in all directions
constexpr std::size_t kMostRefined = 64000;  // more take longer than what they save
constexpr double kCaseTooLow = 0.5;          // what an estimate's logarithm may be too low by at least
constexpr std::size_t kAtOnce = 8;  // scenes that are worked out before the next look at what matters
constexpr std::size_t kMostWorkedOut = 400;  // likely scenes; others count by their estimates
constexpr std::size_t kTried = 4;            // scenes with which a case is tried before pairs are looked at

}  // namespace

ScreenedCases::ScreenedCases(UnknownBridge& bridge, const Observation& observation, const SceneTable& table,
                             std::span<const UnknownCase> cases, std::span<const std::size_t> rows,
                             std::span<const double> beforehand)
    : bridge_(bridge),
      observation_(observation),
      table_(table),
      rows_(rows),
      beforehand_(beforehand),
      estimates_(bridge, observation, table, cases, rows, beforehand),
      likelihoods_(bridge, observation, table),
      too_low_(kCaseTooLow),
      exact_(rows.size()),
      is_worked_out_(rows.size(), false) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool few = table.most_missing < 2 || table.removed[rows[i] * table.most_missing + 1] < 0;
    (few ? few_ : many_).push_back(i);
  }
  for (const UnknownCase& one : cases) {
    set_case(observation, one, bridge);
    terms_.push_back(case_terms(bridge));
  }
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

/// Cases of one level: first the scenes with few missing blocks, which show how likely scenes are.
void ScreenedCases::look_at_level() {
  const std::size_t first = estimates_.look_at_next();
  estimates_.estimate(few_, kImpossible);
  estimates_.refine(few_, first, ScreenDirections::more, kImpossible);
  for (std::size_t number = first; number < estimates_.looked_at(); ++number) try_case(number);
  look_at_many(first);
}

/// Works out the scenes with few missing blocks that seem the likeliest in a case.
void ScreenedCases::try_case(std::size_t number) {
  std::vector<double> estimates(rows_.size(), kImpossible);
  for (const std::size_t place : few_) estimates[place] = estimates_.of(place, number);
  work_out(first_of(few_, estimates, kTried), [&](std::size_t, std::size_t k) { return k == number; });
  for (const std::size_t place : few_)
    if (!exact_[place].empty()) check_estimate(place, number);
}

/// Scenes with many missing blocks are looked at no better than they have to be; the likeliest of them are
/// worked out to know how well that is.
void ScreenedCases::look_at_many(std::size_t first) {
  estimates_.estimate(many_, least_counted());
  estimates_.add_up(many_);
  work_out(first_of(many_, estimates_.sums(), kAtOnce), [&](std::size_t place, std::size_t number) {
    return number < estimates_.looked_at() && may_matter(place, number);
  });
  const double least = least_counted();
  std::vector<std::size_t> places;
  for (const std::size_t place : many_)
    if (!(estimates_.sums()[place] < least)) places.push_back(place);
  estimates_.refine(places, first, ScreenDirections::more, least);
  estimates_.add_up(places);
}

/// Places in the order of estimates, the intact bridge first: its estimate is right but for what lies in no
/// direction.
std::vector<std::size_t> ScreenedCases::first_of(std::vector<std::size_t> places,
                                                 std::span<const double> estimates, std::size_t count) const {
  std::erase_if(places, [&](std::size_t place) { return !(estimates[place] > kImpossible); });
  places = largest_places(std::move(places), estimates, count);
  const auto intact = std::find_if(places.begin(), places.end(), [&](std::size_t place) {
    return table_.removed[rows_[place] * table_.most_missing] < 0;
  });
  if (intact != places.end()) std::rotate(places.begin(), intact, intact + 1);
  return places;
}

/// All scenes that may count, and at least so many.
std::vector<std::size_t> ScreenedCases::most_likely(std::size_t count) const {
  const double least = least_counted();
  std::vector<std::size_t> places;
  for (std::size_t place = 0; place < rows_.size(); ++place)
    if (!(estimates_.sums()[place] < least)) places.push_back(place);
  if (places.size() >= count) return first_of(std::move(places), estimates_.sums(), rows_.size());
  places.resize(rows_.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  return first_of(std::move(places), estimates_.sums(), count);
}

/// Of a scene that was worked out in a case, if it is likely: how much its estimate is too low.
void ScreenedCases::check_estimate(std::size_t place, std::size_t number) {
  const double log = exact_[place][number] + beforehand_[place];
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
  for (const double one : exact_[place])
    if (one != kNotWorkedOut) sum = log_sum(sum, one);
  return sum;
}

/// Tries all cases with a few scenes, then looks at those of each level.
void ScreenedCases::look_at_cases() {
  work_out(nearest_singles(), [](std::size_t, std::size_t) { return true; });
  while (estimates_.looked_at() < terms_.size()) look_at_level();
  estimates_.add_up(few_);
}

/// How far sums of estimates are too high, of scenes that are worked out.
double ScreenedCases::shift_of(std::span<const std::size_t> places) const {
  double exact = kImpossible, estimated = kImpossible;
  for (const std::size_t place : places) {
    if (!std::isfinite(estimates_.sums()[place])) continue;
    exact = log_sum(exact, total(place) + beforehand_[place]);
    estimated = log_sum(estimated, estimates_.sums()[place]);
  }
  return exact > kImpossible ? std::min(0.0, exact - estimated) : 0.0;
}

/// The sum of all estimates at each place of the order and behind it, and of those that are not in it.
std::vector<double> ScreenedCases::left_behind(std::span<const std::size_t> order) const {
  std::vector<bool> is_ordered(rows_.size(), false);
  for (const std::size_t place : order) is_ordered[place] = true;
  double others = 0.0;
  for (std::size_t place = 0; place < rows_.size(); ++place)
    if (!is_ordered[place]) others += std::exp(estimates_.sums()[place] - best_);
  std::vector<double> left(order.size() + 1, best_ + std::log(others));
  for (std::size_t i = order.size(); i-- > 0;) left[i] = log_sum(left[i + 1], estimates_.sums()[order[i]]);
  return left;
}

/// Looks closer at scenes in the order of their estimates, until what is left does not matter.
void ScreenedCases::refine_likely(std::size_t count) {
  work_out_where_likely(first_of(many_, estimates_.sums(), kAtOnce));
  const std::vector<std::size_t> order = most_likely(count);
  const std::vector<double> left = left_behind(order);
  std::size_t end = 0;
  while (end < std::min(order.size(), kMostRefined) &&
         !(left[end] + too_low_ < best_ + std::log(kLeftUnrefined)))
    ++end;
  const auto likely = std::span(order).first(end);
  estimates_.refine(likely, 0, ScreenDirections::all, best_ - too_low_ - kNegligibleCase);
  estimates_.add_up(likely);
  for (const std::size_t place : likely)
    for (std::size_t number = 0; number < exact_[place].size(); ++number) check_estimate(place, number);
}

/// Works out scenes in the order of their estimates, so many at a time, until what is left can change no
/// probability by more than kLeftEstimated. If more scenes than can be worked out are likely indeed, the
/// others count by their estimates, shifted by what those of the last worked out are off.
double ScreenedCases::work_out_likely(std::size_t count) {
  const std::vector<std::size_t> order = most_likely(count);
  const std::vector<double> left = left_behind(order);
  std::vector<std::size_t> tried;
  for (std::size_t place = 0; place < rows_.size(); ++place)
    if (!exact_[place].empty()) tried.push_back(place);
  work_out_where_likely(tried);
  double shift = 0.0;
  std::size_t likely = 0;
  for (std::size_t first = 0; first < order.size(); first += kAtOnce) {
    const bool enough = left[first] + too_low_ < best_ + std::log(kLeftEstimated);
    if (first >= count && (enough || likely >= kMostWorkedOut)) break;
    const auto some = std::span(order).subspan(first, std::min(kAtOnce, order.size() - first));
    work_out_where_likely(some);
    shift = shift_of(some);
    for (const std::size_t place : some)
      if (total(place) + beforehand_[place] > best_ + std::log(kLeftEstimated / kMostWorkedOut)) ++likely;
  }
  return shift;
}

std::vector<double> ScreenedCases::evidence(std::size_t count) {
  count = std::max(count, kAtOnce);
  look_at_cases();
  refine_likely(count);
  const double shift = work_out_likely(count);
  std::vector<double> result(rows_.size(), kImpossible);
  const double log_cases = std::log(static_cast<double>(terms_.size()));
  for (std::size_t place = 0; place < rows_.size(); ++place) {
    if (std::isinf(estimates_.sums()[place]) && estimates_.sums()[place] > 0.0)
      work_out_where_likely({&place, 1});
    const double log =
        is_worked_out_[place] ? total(place) : estimates_.sums()[place] - beforehand_[place] + shift;
    result[place] = log - log_cases;
  }
  return result;
}

}  // namespace voussoir
