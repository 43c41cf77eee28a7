#include "tools/reproduction/findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tools/reproduction/shares.h"
#include "tools/reproduction/subject.h"

namespace voussoir {
namespace {

constexpr double kDifferent = 2.0;  // standard errors between two shares that count as different

/// How many standard errors the second share lies above the first (pooled, two binomial samples).
double standard_errors_above(int low, int low_trials, int high, int high_trials) {
  const double pooled = share(low + high, low_trials + high_trials);
  const double variance =
      pooled * (1.0 - pooled) * (1.0 / std::max(1, low_trials) + 1.0 / std::max(1, high_trials));
  const double difference = share(high, high_trials) - share(low, low_trials);
  return variance > 0.0 ? difference / std::sqrt(variance) : 0.0;
}

std::vector<double> ranks(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> result(values.size());
  for (std::size_t i = 0; i < order.size();) {
    std::size_t end = i;
    while (end < order.size() && values[order[end]] == values[order[i]]) ++end;
    for (std::size_t k = i; k < end; ++k) result[order[k]] = 0.5 * static_cast<double>(i + end - 1);
    i = end;
  }
  return result;
}

}  // namespace

double rank_correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const std::vector<double> ra = ranks(a), rb = ranks(b);
  const double mean = 0.5 * static_cast<double>(a.size() - 1);
  double product = 0.0, square_a = 0.0, square_b = 0.0;
  for (std::size_t i = 0; i < ra.size(); ++i) {
    product += (ra[i] - mean) * (rb[i] - mean);
    square_a += (ra[i] - mean) * (ra[i] - mean);
    square_b += (rb[i] - mean) * (rb[i] - mean);
  }
  return square_a > 0.0 && square_b > 0.0 ? product / std::sqrt(square_a * square_b) : 0.0;
}

Finding arch_blocks_mask(const PairSuccess& with_arch, const PairSuccess& without_arch) {
  const Success& with = with_arch.misfit;
  const Success& without = without_arch.misfit;
  const double distance = standard_errors_above(with.first, with.trials, without.first, without.trials);
  return {"A missing arch block hides a second missing block", distance > kDifferent,
          fmt::format("At {:.0f} % noise Eq. 1 puts the true pair first in {:.0f} % of {} random pairs with "
                      "an arch block "
                      "and in {:.0f} % of {} without ({:+.1f} standard errors); the arch block itself is in "
                      "the first pair "
                      "in {:.0f} %. The posterior that knows the noise: {:.0f} % and {:.0f} %.",
                      kPerCent * kComparedNoise, kPerCent * share(with.first, with.trials), with.trials,
                      kPerCent * share(without.first, without.trials), without.trials, distance,
                      kPerCent * share(with_arch.arch_block_found, with.trials),
                      kPerCent * share(with_arch.known.first, with.trials),
                      kPerCent * share(without_arch.known.first, without.trials))};
}

Finding high_blocks_are_easier(const std::vector<CourseSuccess>& courses) {
  std::array<Success, 2> half;  // lower, upper
  for (std::size_t i = 0; i < courses.size(); ++i) {
    Success& success = half.at(2 * i >= courses.size() ? 1 : 0);
    success.trials += courses[i].misfit.trials;
    success.first += courses[i].misfit.first;
  }
  const double distance = standard_errors_above(half[0].first, half[0].trials, half[1].first, half[1].trials);
  return {
      "Blocks in high courses are easier to find", distance > kDifferent,
      fmt::format("At {:.0f} % noise Eq. 1 puts the true block first in {:.0f} % of {} trials in the upper "
                  "half of the "
                  "courses and in {:.0f} % of {} in the lower ({:+.1f} standard errors).",
                  kPerCent * kComparedNoise, kPerCent * share(half[1].first, half[1].trials), half[1].trials,
                  kPerCent * share(half[0].first, half[0].trials), half[0].trials, distance)};
}

Finding pair_is_hard(const PaperCase& pair, const std::vector<CaseResult>& two_blocks) {
  double own = 0.0;
  std::vector<double> others;
  std::string list;
  for (const CaseResult& result : two_blocks) {
    if (result.paper_case.noise != pair.noise) continue;
    const double success = share(result.genetic_found, result.paper_objective.trials);
    if (result.paper_case.scene == pair.scene) {
      own = success;
      continue;
    }
    others.push_back(success);
    list += fmt::format("{}{} {:.0f} %", list.empty() ? "" : ", ", as_printed(result.paper_case.scene),
                        kPerCent * success);
  }
  const auto harder = std::count_if(others.begin(), others.end(), [&](double other) { return other < own; });
  const bool holds = own < 0.5 && 2 * harder < static_cast<std::ptrdiff_t>(others.size());
  return {as_printed(pair.scene) + " is hard to find", holds,
          fmt::format("At {:.0f} % noise {:.0f} % of the seeds find it; {} of {} other pairs of the table "
                      "are harder ({}).",
                      kPerCent * pair.noise, kPerCent * own, harder, others.size(), list)};
}

Finding noise_raises_generations(const std::vector<GenerationsAtNoise>& runs) {
  std::vector<double> noise, generations;
  for (const GenerationsAtNoise& run : runs)
    for (const int count : run.generations) {
      noise.push_back(run.noise);
      generations.push_back(count);
    }
  const double correlation = noise.size() >= 2 ? rank_correlation(noise, generations) : 0.0;
  const double distance =
      correlation * std::sqrt(static_cast<double>(std::max<std::size_t>(1, noise.size()) - 1));
  const GenerationsAtNoise& first = runs.front();
  const GenerationsAtNoise& last = runs.back();
  return {"Noise raises the number of generations", distance > kDifferent,
          fmt::format("Over the {} runs that find the truth the rank correlation of noise and generations is "
                      "{:+.2f} ({:+.1f} "
                      "standard errors). What noise lowers is the share of runs that find it: {:.0f} % at "
                      "{:.0f} % noise, "
                      "{:.0f} % at {:.0f} %.",
                      noise.size(), correlation, distance,
                      kPerCent * share(static_cast<int>(first.generations.size()), first.seeds),
                      kPerCent * first.noise,
                      kPerCent * share(static_cast<int>(last.generations.size()), last.seeds),
                      kPerCent * last.noise)};
}

Table to_table(const std::vector<Finding>& findings) {
  Table table{{"the paper says", "in this run", "by these numbers"}, {}};
  for (const Finding& finding : findings)
    table.rows.push_back({finding.claim, finding.holds ? "holds" : "does not hold", finding.evidence});
  return table;
}

}  // namespace voussoir
