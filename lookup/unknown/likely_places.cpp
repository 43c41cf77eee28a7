#include "lookup/unknown/likely_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <ranges>

#include "core/parts.h"
#include "lookup/evidence/scene_evidence.h"

namespace voussoir {
namespace {

constexpr std::size_t kHistogramBins = 256;
constexpr double kBinsPerUnit = 8.0;  // all bins are a factor of exp(32), each is one of 1.13

/// Values below `top` in bins; what is below all of them counts as if it were in the first.
struct Histogram {
  double top = 0.0;
  std::array<std::size_t, kHistogramBins> counts{};

  std::size_t bin_of(double value) const {
    const double place = static_cast<double>(kHistogramBins) - (top - value) * kBinsPerUnit;
    return place > 0.0 ? std::min(static_cast<std::size_t>(place), kHistogramBins - 1) : 0;
  }
  void add(const Histogram& other) {
    for (std::size_t bin = 0; bin < kHistogramBins; ++bin) counts[bin] += other.counts[bin];
  }
  /// The first bin with which the sum of all exponentials from below is more than exp(top); kHistogramBins if
  /// there is none.
  std::size_t first_that_matters() const {
    double sum = 0.0;  // in shares of exp(top)
    std::size_t bin = 0;
    for (; bin < kHistogramBins; ++bin) {
      const double upper_end = -static_cast<double>(kHistogramBins - bin - 1) / kBinsPerUnit;
      sum += static_cast<double>(counts[bin]) * std::exp(upper_end);
      if (sum > 1.0) break;
    }
    return bin;
  }
};

/// Places of which one thread takes care at a time.
constexpr std::size_t kPart = 16384;

/// What work(some of the places) gives, for all of them in their order.
template <class Result, class Places, class Work>
std::vector<Result> of_parts(const Places& places, Work work) {
  std::vector<Result> results(parts_of(places.size(), kPart));
  for_parts(places.size(), kPart, [&](std::size_t part, std::size_t first, std::size_t count) {
    results[part] = work(places | std::views::drop(first) | std::views::take(count));
  });
  return results;
}

template <class Places>
std::vector<std::size_t> likely_of(const Places& places, std::span<const double> values, double log_rest,
                                   double stays) {
  const auto histograms = of_parts<Histogram>(places, [&](const auto& part) {
    Histogram histogram{log_rest};
    for (const std::size_t place : part)
      if (values[place] < log_rest) ++histogram.counts[histogram.bin_of(values[place])];
    return histogram;
  });
  Histogram all{log_rest};
  for (const Histogram& histogram : histograms) all.add(histogram);
  const std::size_t first = all.first_that_matters();
  const double always = std::min(log_rest, stays);
  const auto chosen = of_parts<std::vector<std::size_t>>(places, [&](const auto& part) {
    std::vector<std::size_t> likely;
    for (const std::size_t place : part)
      if (values[place] != kImpossible && (!(values[place] < always) || all.bin_of(values[place]) >= first))
        likely.push_back(place);
    return likely;
  });
  std::vector<std::size_t> likely;
  for (const std::vector<std::size_t>& some : chosen) likely.insert(likely.end(), some.begin(), some.end());
  return likely;
}

}  // namespace

std::vector<std::size_t> likely_places(std::span<const std::size_t> places, std::span<const double> values,
                                       double log_rest, double stays) {
  return likely_of(places, values, log_rest, stays);
}

std::vector<std::size_t> likely_places(std::span<const double> values, double log_rest, double stays) {
  return likely_of(std::views::iota(std::size_t{0}, values.size()), values, log_rest, stays);
}

}  // namespace voussoir
