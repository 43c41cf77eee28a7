#include "lookup/unknown/case_estimates.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parts.h"
#include "lookup/evidence/scene_evidence.h"

namespace voussoir {
namespace {

/// Calls work(block) for blocks of all places, on all threads.
template <class Work>
void for_blocks(std::span<const std::size_t> places, Work work) {
  constexpr std::size_t kPlaces = 1024;  // of which those that matter still fill lanes
  for_parts(places.size(), kPlaces,
            [&](std::size_t, std::size_t first, std::size_t count) { work(places.subspan(first, count)); });
}

/// How much a density rises at most if the covariance becomes that of another case, which is nowhere wider.
/// Of log det that is as much as for the intact bridge at most, as long as losses widen covariances.
double highest_rise(const ScatterLogs& from, const ScatterLogs& to) {
  double most = kImpossible;
  for (std::size_t k = 0; k < from.size(); ++k) most = std::max(most, to[k] - from[k]);
  return most;
}

}  // namespace

CaseEstimates::CaseEstimates(const UnknownBridge& bridge, const Observation& observation,
                             const SceneTable& table, std::span<const UnknownCase> cases,
                             std::span<const std::size_t> rows, std::span<const double> beforehand)
    : bridge_(bridge),
      observation_(observation),
      table_(table),
      cases_(cases),
      rows_(rows),
      beforehand_(beforehand),
      logs_(rows.size() * cases.size(), static_cast<float>(kImpossible)),
      sums_(rows.size(), kImpossible) {
  const auto count = static_cast<Eigen::Index>(cases.size());
  rises_ = Eigen::MatrixXd::Constant(count, count, std::numeric_limits<double>::infinity());
}

std::pair<std::size_t, std::size_t> CaseEstimates::next_level() const {
  const std::size_t first = looked_at();
  std::size_t end = first;
  while (end < cases_.size() && cases_[end].level == cases_[first].level) ++end;
  return {first, end};
}

void CaseEstimates::look_at_next(const Eigen::MatrixXd& pulls) {
  const auto [first, end] = next_level();
  screens_.emplace_back(bridge_, observation_, table_, cases_.subspan(first, end - first), pulls,
                        hardware_threads());
  for (const ReducedCase& one : screens_.back().cases()) {
    peaks_.push_back(one.peaks);
    add_rises(peaks_.size() - 1);
  }
}

void CaseEstimates::estimate(std::span<const std::size_t> places, double least) {
  const UnknownScreen& screen = screens_.back();
  const std::size_t end = peaks_.size(), first = end - screen.cases().size();
  const Eigen::MatrixXd rises =
      rises_.middleCols(static_cast<Eigen::Index>(first), static_cast<Eigen::Index>(end - first));
  for_blocks(places, [&](std::span<const std::size_t> block) {
    screen.estimate(screened(block, 0, least), rises, first);
    add_up(block, least);
  });
}

void CaseEstimates::refine(std::span<const std::size_t> places, std::size_t from, ScreenDirections directions,
                           double least) {
  for_blocks(places, [&](std::span<const std::size_t> block) {
    std::size_t first = 0;
    for (const UnknownScreen& screen : screens_) {
      if (first >= from) screen.refine(screened(block, first, least), directions);
      first += screen.cases().size();
    }
    add_up(block, least);
  });
}

/// With the logarithms of cases from number `first` on.
std::vector<ScreenedRow> CaseEstimates::screened(std::span<const std::size_t> places, std::size_t first,
                                                 double least) {
  std::vector<ScreenedRow> rows;
  rows.reserve(places.size());
  for (const std::size_t place : places)
    rows.push_back({rows_[place], least - beforehand_[place], logs_.data() + place * cases_.size() + first});
  return rows;
}

/// From all cases before it with the same conditions. Wider conditions say nothing: they widen what is not
/// known of a collapse at all points by a hundred times and more, and the intact bridge not at all.
void CaseEstimates::add_rises(std::size_t number) {
  const UnknownCase& to = cases_[number];
  for (std::size_t i = 0; i < number; ++i)
    if (to.level <= cases_[i].level && to.conditions == cases_[i].conditions)
      rises_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(number)) =
          highest_rise(peaks_[i], peaks_[number]);
}

void CaseEstimates::add_up(std::span<const std::size_t> places, double least) {
  const double most = std::log(static_cast<double>(cases_.size()));  // by which a sum is above its largest
  for (const std::size_t place : places) {
    const auto logs = std::span(logs_).subspan(place * cases_.size(), cases_.size());
    const double largest = static_cast<double>(*std::max_element(logs.begin(), logs.end()));
    const bool matters = largest + beforehand_[place] >= least;
    sums_[place] = beforehand_[place] + (matters ? sum_over_cases(logs, largest) : largest + most);
  }
}

/// Cases that add nothing to the largest are not worth an exponential.
double CaseEstimates::sum_over_cases(std::span<const float> logs, double largest) {
  constexpr double kNothing = 40.0;
  if (std::isinf(largest)) return largest;
  double sum = 0.0;
  for (const double log : logs)
    if (log > largest - kNothing) sum += log == largest ? 1.0 : std::exp(log - largest);
  return largest + std::log(sum);
}

}  // namespace voussoir
