#include "lookup/evidence/screened_cases.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/threads.h"
#include "lookup/evidence/scene_evidence.h"

namespace voussoir {
namespace {

constexpr double kImpossible = -std::numeric_limits<double>::infinity();
constexpr double kNone = -std::numeric_limits<double>::max();
constexpr double kNegligible = 20.0;     // logarithm of how far behind the likeliest a case is given up
constexpr double kUncounted = 3e-4;      // probability of all scenes that are left at their first estimates
constexpr double kLeftEstimated = 5e-4;  // probability of all scenes that are not worked out
constexpr double kTooLow = 0.5;          // an estimate's logarithm is hardly ever too low by more than this
constexpr double kEstimate = 6.0;        // nor too high by so much less than those of likely scenes
constexpr std::size_t kAtOnce = 8;       // scenes that are worked out before the next look at what matters
constexpr std::size_t kMostWorkedOut = 96;  // scenes; others that may matter count by their estimates
constexpr std::size_t kRemembered = 4;      // likeliest scenes of one case that others are tried with

/// An estimate that failed counts as likely: the scene is worked out.
double usable(double estimate) {
  return std::isnan(estimate) ? std::numeric_limits<double>::infinity() : estimate;
}

}  // namespace

ScreenedCases::ScreenedCases(UnknownBridge& bridge, const Observation& observation, const SceneTable& table,
                             std::span<const UnknownCase> cases, std::span<const std::size_t> rows,
                             std::span<const double> beforehand)
    : bridge_(bridge),
      observation_(observation),
      table_(table),
      rows_(rows),
      beforehand_(beforehand),
      exact_(rows.size()) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool few = table.most_missing < 2 || table.removed[rows[i] * table.most_missing + 1] < 0;
    (few ? few_ : many_).push_back(i);
  }
  for (const UnknownCase& one : cases) {
    set_case(observation, one, bridge);
    cases_.push_back({one, case_terms(bridge)});
  }
  estimate_.assign(rows.size(), kImpossible);
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
    if (places.size() < kRemembered || table_.removed[rows_[place] * table_.most_missing] < 0)
      places.push_back(place);
  return places;
}

void ScreenedCases::estimate(const UnknownScreen& screen, std::span<const std::size_t> places, double least,
                             std::vector<double>& estimates) const {
  std::vector<std::size_t> rows;
  std::vector<double> leasts;
  for (const std::size_t place : places) {
    rows.push_back(rows_[place]);
    leasts.push_back(least - beforehand_[place]);
  }
  const std::vector<double> logs = screen.estimates(rows, leasts);
  for (std::size_t i = 0; i < places.size(); ++i)
    estimates[places[i]] = usable(logs[i]) + beforehand_[places[i]];
}

/// Estimates all scenes in a case; those with many missing blocks no better than they have to be, which the
/// likeliest of the others show.
void ScreenedCases::look_at(Case& one) {
  set_case(observation_, one.one, bridge_);
  const UnknownScreen screen(bridge_, observation_, table_, hardware_threads());
  one.estimate.assign(rows_.size(), kImpossible);
  estimate(screen, few_, kImpossible, one.estimate);
  work_out(first_of(few_, one.estimate, kRemembered), kNone);
  estimate(screen, many_, best_ + std::log(kUncounted / static_cast<double>(rows_.size())), one.estimate);
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (one.estimate[i] > kImpossible) estimate_[i] = log_sum(estimate_[i], one.estimate[i]);
}

/// Places in the order of estimates, the intact bridge first: its estimate is right but for what lies in no
/// direction.
std::vector<std::size_t> ScreenedCases::first_of(std::vector<std::size_t> places,
                                                 std::span<const double> estimates, std::size_t count) const {
  std::erase_if(places, [&](std::size_t place) { return !(estimates[place] > kImpossible); });
  const auto end = places.begin() + static_cast<std::ptrdiff_t>(std::min(count, places.size()));
  std::partial_sort(places.begin(), end, places.end(), [&](std::size_t a, std::size_t b) {
    return estimates[a] != estimates[b] ? estimates[a] > estimates[b] : a < b;
  });
  places.erase(end, places.end());
  const auto intact = std::find_if(places.begin(), places.end(), [&](std::size_t place) {
    return table_.removed[rows_[place] * table_.most_missing] < 0;
  });
  if (intact != places.end()) std::rotate(places.begin(), intact, intact + 1);
  return places;
}

std::vector<std::size_t> ScreenedCases::most_likely(std::size_t count) const {
  std::vector<std::size_t> places(rows_.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  return first_of(std::move(places), estimate_, count);
}

/// In all cases that were not found to be worse than this.
void ScreenedCases::work_out(std::span<const std::size_t> places, double worst_case) {
  std::vector<std::size_t> missing, rows;
  std::vector<CaseTerms> terms;
  for (const std::size_t place : places)
    if (exact_[place].empty()) missing.push_back(place), rows.push_back(rows_[place]);
  for (const Case& one : cases_) terms.push_back(one.terms);
  std::vector<std::uint8_t> wanted;
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (const Case& one : cases_)
      wanted.push_back(one.best_tried > kImpossible && one.best_tried < worst_case ? 0 : 1);
  const auto logs = scatter_logs(bridge_, terms, observation_, table_, rows, wanted, hardware_threads());
  for (std::size_t i = 0; i < logs.size(); ++i) {
    const std::size_t place = missing[i / cases_.size()], number = i % cases_.size();
    exact_[place].push_back(over_scatter(logs[i]));
    const double log = exact_[place].back() + beforehand_[place];
    cases_[number].best_tried = std::max(cases_[number].best_tried, log);
    if (log > best_) best_ = log, likeliest_ = number;
  }
}

/// log of the sum over cases.
double ScreenedCases::total(std::size_t place) const {
  double sum = kImpossible;
  for (const double one : exact_[place]) sum = log_sum(sum, one);
  return sum;
}

/// Tries all cases with a few scenes, looks at the likeliest case, tries all cases with the scenes that it
/// shows to be likely, and so on until no case is left that can matter.
void ScreenedCases::look_at_cases() {
  work_out(nearest_singles(), kNone);
  while (true) {
    Case* next = nullptr;
    for (Case& one : cases_)
      if (one.estimate.empty() && (next == nullptr || one.best_tried > next->best_tried)) next = &one;
    if (next == nullptr || next->best_tried < best_ - kNegligible) return;
    look_at(*next);
    work_out(most_likely(kRemembered), kNone);
  }
}

/// log of the sum of the estimates of all places but these.
double ScreenedCases::others_estimate(std::span<const std::size_t> places) const {
  std::vector<bool> among(rows_.size(), false);
  for (const std::size_t place : places) among[place] = true;
  double sum = 0.0;
  for (std::size_t place = 0; place < rows_.size(); ++place)
    if (!among[place]) sum += std::exp(estimate_[place] - best_);
  return std::log(sum) + best_;
}

/// How far sums of estimates are off, of scenes that are worked out.
double ScreenedCases::shift_of(std::span<const std::size_t> places) const {
  double exact = kImpossible, estimated = kImpossible;
  for (const std::size_t place : places) {
    if (!std::isfinite(estimate_[place])) continue;
    exact = log_sum(exact, total(place) + beforehand_[place]);
    estimated = log_sum(estimated, estimate_[place]);
  }
  return exact > kImpossible ? exact - estimated : 0.0;
}

/// Works out scenes in the order of their estimates, so many at a time, until what is left can change no
/// probability by more than kLeftEstimated, and those without an estimate; the others count by their
/// estimates, shifted by what those of the last worked out are off.
std::vector<double> ScreenedCases::evidence(std::size_t count) {
  look_at_cases();
  const std::vector<std::size_t> order = most_likely(std::max(count, kMostWorkedOut));
  std::vector<double> left(order.size() + 1, others_estimate(order));  // at each place and behind it
  for (std::size_t i = order.size(); i-- > 0;) left[i] = log_sum(left[i + 1], estimate_[order[i]]);
  double shift = 0.0, most_shift = kImpossible;  // of exact less estimate
  for (std::size_t first = 0; first < order.size(); first += kAtOnce) {
    const double too_low = std::min(kTooLow, most_shift + kEstimate);
    if (first >= std::max(count, kAtOnce) && left[first] + too_low < best_ + std::log(kLeftEstimated)) break;
    const auto some = std::span(order).subspan(first, std::min(kAtOnce, order.size() - first));
    work_out(some, best_ - kNegligible);
    shift = shift_of(some);
    for (const std::size_t place : some) {
      const double off = total(place) + beforehand_[place] - estimate_[place];
      if (std::isfinite(off)) most_shift = std::max(most_shift, off);
    }
  }
  std::vector<double> result(rows_.size(), kImpossible);
  const double log_cases = std::log(static_cast<double>(cases_.size()));
  for (std::size_t place = 0; place < rows_.size(); ++place) {
    if (std::isinf(estimate_[place]) && estimate_[place] > 0.0) work_out({&place, 1}, best_ - kNegligible);
    const double log = exact_[place].empty() ? estimate_[place] - beforehand_[place] + shift : total(place);
    result[place] = log - log_cases;
  }
  return result;
}

}  // namespace voussoir
