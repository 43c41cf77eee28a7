#include "lookup/evidence/screened_cases.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/threads.h"
#include "lookup/evidence/scene_evidence.h"

namespace voussoir {
namespace {

constexpr double kImpossible = -std::numeric_limits<double>::infinity();
constexpr double kNotWorkedOut = std::numeric_limits<double>::infinity();
constexpr double kNegligible = 20.0;  // logarithm of how far behind the likeliest a scene's case is left out
constexpr double kUncounted = 3e-4;   // probability of all scenes that are left at their first estimates
constexpr double kLeftEstimated = 5e-4;  // probability of all scenes that are not worked out
constexpr double kTooLow = 0.5;          // what an estimate's logarithm may be too low by at least
constexpr std::size_t kAtOnce = 8;       // scenes that are worked out before the next look at what matters
constexpr std::size_t kMostWorkedOut = 400;  // likely scenes; others count by their estimates
constexpr std::size_t kTried = 4;            // scenes with which a case is tried before pairs are looked at

/// An estimate that failed counts as likely: the scene is worked out.
double usable(double estimate) {
  return std::isnan(estimate) ? std::numeric_limits<double>::infinity() : estimate;
}

/// How much a density rises at most if the covariance becomes that of another case, which is nowhere wider.
/// Of log det that is as much as for the intact bridge at most, as long as losses widen covariances.
double highest_rise(const ScatterLogs& from, const ScatterLogs& to) {
  double most = kImpossible;
  for (std::size_t k = 0; k < from.size(); ++k) most = std::max(most, to[k] - from[k]);
  return most;
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
      likelihoods_(bridge, observation, table),
      too_low_(kTooLow),
      exact_(rows.size()),
      is_worked_out_(rows.size(), false) {
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
    if (places.size() < kTried || table_.removed[rows_[place] * table_.most_missing] < 0)
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

/// Scenes with many missing blocks that may matter in a case, by its highest density and by what cases with
/// wider covariances left of them. The others' estimates become these bounds.
std::vector<std::size_t> ScreenedCases::not_ruled_out(Case& one, double least) const {
  std::vector<double>& bounds = one.estimate;
  for (const std::size_t place : many_) bounds[place] = over_scatter(one.peaks) + beforehand_[place];
  for (const Case& wider : cases_) {
    if (&wider == &one) break;
    const bool next = wider.one.level == one.one.level || wider.one.conditions == one.one.conditions;
    if (!next || wider.one.conditions < one.one.conditions) continue;
    const double more = highest_rise(wider.peaks, one.peaks);
    for (const std::size_t place : many_)
      bounds[place] = std::min(bounds[place], wider.estimate[place] + more);
  }
  std::vector<std::size_t> places;
  for (const std::size_t place : many_)
    if (!(bounds[place] < least)) places.push_back(place);
  return places;
}

/// Estimates all scenes in a case; those with many missing blocks no better than they have to be, which the
/// likeliest of the others show.
void ScreenedCases::look_at(Case& one) {
  set_case(observation_, one.one, bridge_);
  const UnknownScreen screen(bridge_, observation_, table_, hardware_threads());
  one.peaks = screen.peaks();
  one.estimate.assign(rows_.size(), kImpossible);
  estimate(screen, few_, kImpossible, one.estimate);
  const auto here = static_cast<std::size_t>(&one - cases_.data());
  work_out(first_of(few_, one.estimate, kTried), [&](std::size_t, std::size_t k) { return k == here; });
  for (const std::size_t place : few_)
    if (!exact_[place].empty()) check_estimate(place, here);
  const double least =
      best_ - too_low_ + std::log(kUncounted / static_cast<double>(rows_.size() * cases_.size()));
  estimate(screen, not_ruled_out(one, least), least, one.estimate);
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

/// Of a scene that was worked out in a case, if it is likely: how much its estimate is too low.
void ScreenedCases::check_estimate(std::size_t place, std::size_t number) {
  const std::vector<double>& estimates = cases_[number].estimate;
  const double log = exact_[place][number] + beforehand_[place];
  if (!estimates.empty() && exact_[place][number] != kNotWorkedOut && log > best_ - kNegligible)
    too_low_ = std::max(too_low_, log - estimates[place]);
}

/// In the cases that are wanted of each place, by their numbers, those worked out before left out.
void ScreenedCases::work_out(std::span<const std::size_t> places, const WantedCase& is_wanted,
                             const Eigen::MatrixXd* rise) {
  std::vector<std::size_t> rows;
  std::vector<CaseTerms> terms;
  std::vector<std::uint8_t> missing;
  CasePruning pruning;
  std::vector<double> least;
  for (const std::size_t place : places) least.push_back(best_ - too_low_ - kNegligible - beforehand_[place]);
  if (rise != nullptr) pruning = {least, *rise};
  for (const Case& one : cases_) terms.push_back(one.terms);
  for (const std::size_t place : places) {
    rows.push_back(rows_[place]);
    std::vector<double>& exact = exact_[place];
    exact.resize(cases_.size(), kNotWorkedOut);
    for (std::size_t k = 0; k < cases_.size(); ++k)
      missing.push_back(is_wanted(place, k) && exact[k] == kNotWorkedOut);
  }
  const auto logs =
      likelihoods_(terms, rows, missing, hardware_threads(), rise != nullptr ? &pruning : nullptr);
  for (std::size_t i = 0; i < logs.size(); ++i) {
    if (missing[i] == 0) continue;
    const std::size_t place = places[i / cases_.size()], number = i % cases_.size();
    exact_[place][number] = over_scatter(logs[i]);
    const double log = exact_[place][number] + beforehand_[place];
    if (log > best_) best_ = log, likeliest_ = number;
    check_estimate(place, number);
  }
}

/// In all cases that may matter beside the likeliest scene's.
void ScreenedCases::work_out_where_likely(std::span<const std::size_t> places) {
  for (const std::size_t place : places) is_worked_out_[place] = true;
  const auto may_matter = [&](std::size_t place, std::size_t number) {
    return !(cases_[number].estimate[place] + too_low_ < best_ - kNegligible);
  };
  work_out(places, may_matter, &rise_);
}

/// log of the sum over the cases in which the place was worked out.
double ScreenedCases::total(std::size_t place) const {
  double sum = kImpossible;
  for (const double one : exact_[place])
    if (one != kNotWorkedOut) sum = log_sum(sum, one);
  return sum;
}

/// Tries all cases with a few scenes, then looks at each of them.
void ScreenedCases::look_at_cases() {
  work_out(nearest_singles(), [](std::size_t, std::size_t) { return true; });
  for (Case& one : cases_) look_at(one);
  rise_ = rises();
}

/// From each case to those that are nowhere wider.
Eigen::MatrixXd ScreenedCases::rises() const {
  const auto count = static_cast<Eigen::Index>(cases_.size());
  Eigen::MatrixXd result = Eigen::MatrixXd::Constant(count, count, std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < cases_.size(); ++i)
    for (std::size_t j = i + 1; j < cases_.size(); ++j)
      if (cases_[j].one.level <= cases_[i].one.level && cases_[j].one.conditions <= cases_[i].one.conditions)
        result(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
            highest_rise(cases_[i].peaks, cases_[j].peaks);
  return result;
}

/// How far sums of estimates are too high, of scenes that are worked out.
double ScreenedCases::shift_of(std::span<const std::size_t> places) const {
  double exact = kImpossible, estimated = kImpossible;
  for (const std::size_t place : places) {
    if (!std::isfinite(estimate_[place])) continue;
    exact = log_sum(exact, total(place) + beforehand_[place]);
    estimated = log_sum(estimated, estimate_[place]);
  }
  return exact > kImpossible ? std::min(0.0, exact - estimated) : 0.0;
}

/// Works out scenes in the order of their estimates, so many at a time, until what is left can change no
/// probability by more than kLeftEstimated. If more scenes than can be worked out are likely indeed, the
/// others count by their estimates, shifted by what those of the last worked out are off.
double ScreenedCases::work_out_likely(std::size_t count) {
  const std::vector<std::size_t> order = most_likely(rows_.size());
  std::vector<double> left(order.size() + 1, kImpossible);  // at each place and behind it
  for (std::size_t i = order.size(); i-- > 0;) left[i] = log_sum(left[i + 1], estimate_[order[i]]);
  for (std::size_t place = 0; place < rows_.size(); ++place)
    if (!exact_[place].empty()) work_out_where_likely({&place, 1});  // was tried
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
  look_at_cases();
  const double shift = work_out_likely(std::max(count, kAtOnce));
  std::vector<double> result(rows_.size(), kImpossible);
  const double log_cases = std::log(static_cast<double>(cases_.size()));
  for (std::size_t place = 0; place < rows_.size(); ++place) {
    if (std::isinf(estimate_[place]) && estimate_[place] > 0.0) work_out_where_likely({&place, 1});
    const double log = is_worked_out_[place] ? total(place) : estimate_[place] - beforehand_[place] + shift;
    result[place] = log - log_cases;
  }
  return result;
}

}  // namespace voussoir
