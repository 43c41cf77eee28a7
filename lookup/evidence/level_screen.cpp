#include "lookup/evidence/level_screen.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lookup/evidence/evidence.h"
#include "lookup/evidence/largest_places.h"
#include "lookup/evidence/level_evidence.h"
#include "lookup/evidence/scene_evidence.h"

namespace voussoir {
namespace {

constexpr std::size_t kFirstRows = 32;     // rows that are worked out first, under the first shapes
constexpr double kTooLow = 2.0;            // what an estimate's logarithm may be too low by at least
constexpr double kCountsForTooLow = 25.0;  // rows so far behind the best say nothing of that
constexpr double kBin = 0.05;              // of logarithms, for sums over rows in the order of estimates
constexpr std::size_t kBins = 2000;
constexpr double kCoarseShare = 1e-3;  // of the probability, of rows that are worked out less precisely

/// What is known of each row under one group of shapes.
struct Group {
  std::vector<NoiseShape> shapes;
  double level = 0.0;            ///< where the readings are likeliest
  std::vector<double> estimate;  ///< with what was known beforehand
  std::vector<double> exact;     ///< the same; -infinity until worked out
  std::vector<bool> is_worked_out;
  double too_low = kTooLow;  ///< estimates of likely rows were found to be too low by no more
};

class LevelScreen {
 public:
  LevelScreen(const Observation& observation, const SceneTable& table, std::span<const std::size_t> rows,
              std::span<const double> beforehand, std::span<const std::size_t> likely)
      : observation_(observation), table_(table), rows_(rows), beforehand_(beforehand) {
    const auto shapes = static_cast<double>(shapes_of(observation.noise).size());
    for (const auto& group : groups_of(observation.noise)) {
      Group& added = groups_.emplace_back();
      added.shapes = group;
      estimate(added, likely);
      const double share = std::log(static_cast<double>(group.size()) / shapes);
      for (std::size_t i = 0; i < rows.size(); ++i) added.estimate[i] += share + beforehand[i];
      added.exact.assign(rows.size(), kImpossible);
      added.is_worked_out.assign(rows.size(), false);
    }
    log_shapes_ = std::log(shapes);
  }

  std::vector<double> evidence(std::size_t count, double left_out) {
    work_out(groups_.front(), first_of(groups_.front(), std::max(count, kFirstRows)), LevelRule::fine);
    for (const auto& [share, rule] :
         {std::pair{kCoarseShare, LevelRule::fine}, std::pair{left_out, LevelRule::coarse}})
      while (work_out_above(count, share, rule)) {
      }
    std::vector<double> result = totals();
    for (std::size_t i = 0; i < result.size(); ++i) result[i] -= beforehand_[i];
    return result;
  }

 private:
  void estimate(Group& group, std::span<const std::size_t> likely) const {
    if (observation_.unknown_level) {
      group.level = likeliest_level(observation_, group.shapes, table_, likely);
      group.estimate = estimated_peaks(observation_, group.shapes, group.level, table_, rows_);
      const double width = log_width(group.shapes.back(), observation_.count);
      for (double& log : group.estimate) log += width;
    } else {
      group.level = stated_level(observation_);
      group.estimate = highest_likelihoods_at(observation_, group.shapes, group.level, table_, rows_);
      group.too_low = kLogRoundOff;
    }
  }

  std::vector<std::vector<double>> logs_of(const Group& group, std::span<const std::size_t> rows,
                                           LevelRule rule) const {
    if (observation_.unknown_level)
      return evidence_over_levels(observation_, group.shapes, group.level, table_, rows, rule);
    return log_likelihoods_at(observation_, group.shapes, group.level, table_, rows);
  }

  std::vector<std::size_t> first_of(const Group& group, std::size_t count) const {
    std::vector<std::size_t> places = largest_places(group.estimate, count);
    std::erase_if(places, [&](std::size_t place) { return group.estimate[place] == kImpossible; });
    std::sort(places.begin(), places.end());
    return places;
  }

  void work_out(Group& group, const std::vector<std::size_t>& places, LevelRule rule) {
    if (places.empty()) return;
    std::vector<std::size_t> rows;
    for (const std::size_t place : places) rows.push_back(rows_[place]);
    const auto logs = logs_of(group, rows, rule);
    for (std::size_t i = 0; i < places.size(); ++i) {
      double& sum = group.exact[places[i]];
      for (const std::vector<double>& of_shape : logs) sum = log_sum(sum, of_shape[i]);
      sum += beforehand_[places[i]] - log_shapes_;
      group.is_worked_out[places[i]] = true;
      best_ = std::max(best_, sum);
    }
    for (const std::size_t place : places)
      if (group.exact[place] > best_ - kCountsForTooLow)
        group.too_low = std::max(group.too_low, group.exact[place] - group.estimate[place]);
  }

  /// log of the sum over shapes, for each row.
  std::vector<double> totals() const {
    std::vector<double> result(rows_.size(), kImpossible);
    for (const Group& group : groups_)
      for (std::size_t i = 0; i < result.size(); ++i)
        if (group.is_worked_out[i]) result[i] = log_sum(result[i], group.exact[i]);
    return result;
  }

  /// The estimate below which all rows and shapes together may be left out: they hold less than the share,
  /// and none is one of the `count` likeliest.
  double least_that_matters(std::size_t count, double share) const {
    std::vector<double> values = totals();
    std::erase(values, kImpossible);
    if (values.empty()) return kImpossible;
    const double all = std::accumulate(values.begin(), values.end(), kImpossible, log_sum);
    std::vector<std::size_t> held(kBins, 0);  // what is estimated to lie between all - i kBin and the next
    for (const Group& group : groups_)
      for (std::size_t i = 0; i < rows_.size(); ++i) {
        if (group.is_worked_out[i]) continue;
        const double most = group.estimate[i] + group.too_low, below = std::max(0.0, (all - most) / kBin);
        if (below < static_cast<double>(kBins)) ++held[static_cast<std::size_t>(below)];
      }
    std::size_t bin = kBins;
    const auto most_of = [&](std::size_t i) {
      return static_cast<double>(held[i]) * std::exp(-static_cast<double>(i) * kBin);
    };
    for (double sum = 0.0; bin > 0 && sum + most_of(bin - 1) <= share; --bin) sum += most_of(bin - 1);
    count = std::min(count, values.size());
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count - 1), values.end(),
                     std::greater<>());
    return std::min(values[count - 1], all - static_cast<double>(bin) * kBin);
  }

  /// False if nothing was left to work out.
  bool work_out_above(std::size_t count, double share, LevelRule rule) {
    const double least = least_that_matters(count, share);
    bool any = false;
    for (Group& group : groups_) {
      std::vector<std::size_t> places;
      for (std::size_t i = 0; i < rows_.size(); ++i)
        if (!group.is_worked_out[i] && group.estimate[i] > kImpossible &&
            group.estimate[i] + group.too_low >= least)
          places.push_back(i);
      any |= !places.empty();
      work_out(group, places, rule);
    }
    return any;
  }

  const Observation& observation_;
  const SceneTable& table_;
  std::span<const std::size_t> rows_;
  std::span<const double> beforehand_;
  std::vector<Group> groups_;
  double log_shapes_ = 0.0;
  double best_ = kImpossible;  // of any row under any group
};

}  // namespace

std::vector<double> evidence_that_matters(const Observation& observation, const SceneTable& table,
                                          std::span<const std::size_t> rows,
                                          std::span<const double> beforehand,
                                          std::span<const std::size_t> likely, std::size_t count,
                                          double left_out) {
  return LevelScreen(observation, table, rows, beforehand, likely).evidence(count, left_out);
}

}  // namespace voussoir
