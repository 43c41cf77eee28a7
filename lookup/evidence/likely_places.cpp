#include "lookup/evidence/likely_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <ranges>

namespace voussoir {
namespace {

constexpr std::size_t kHistogramBins = 256;
constexpr double kBinsPerUnit = 8.0;  // all bins are a factor of exp(32), each is one of 1.13

/// Values below `top` in bins; what is below all of them counts as if it were in the first.
struct Histogram {
  double top;
  std::array<std::size_t, kHistogramBins> counts{};

  std::size_t bin_of(double value) const {
    const double place = static_cast<double>(kHistogramBins) - (top - value) * kBinsPerUnit;
    return place > 0.0 ? std::min(static_cast<std::size_t>(place), kHistogramBins - 1) : 0;
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

template <class Places>
std::vector<std::size_t> likely_of(const Places& places, std::span<const double> values, double log_rest,
                                   double stays) {
  Histogram histogram{log_rest};
  for (const std::size_t place : places)
    if (values[place] < log_rest) ++histogram.counts[histogram.bin_of(values[place])];
  const std::size_t first = histogram.first_that_matters();
  std::vector<std::size_t> likely;
  for (const std::size_t place : places)
    if (!(values[place] < std::min(log_rest, stays)) || histogram.bin_of(values[place]) >= first)
      likely.push_back(place);
  std::erase_if(likely, [&](std::size_t place) { return std::isinf(values[place]) && values[place] < 0.0; });
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
