#include "lookup/evidence/box_variances.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lookup/evidence/wide_product.h"

namespace voussoir {
namespace {

constexpr std::size_t kMostKept = std::size_t{1} << 23U;  // places: 64 MiB

/// Stores the weights of one box and returns the product of its least variances.
VOUSSOIR_INLINE WideProduct variances_in(const PlaceArrays& arrays, const ClusterBox& box, double* weight) {
  const DoubleLanes zero{}, one = DoubleLanes{} + 1.0;
  const CommonVariance common = common_variance_in(arrays, box);
  const double unit = arrays.inverse_unit * arrays.inverse_unit;
  DoubleLanes product = one;
  WideProduct wide;
  for (std::size_t i = 0, step = 1; i < arrays.reading.size(); i += kLanes, ++step) {
    const PlaceBounds at = place_bounds(arrays, box, i, common);
    const DoubleLanes most = at.most_instrument * at.most_instrument + at.most_variance;
    const DoubleLanes least = at.least_instrument * at.least_instrument + at.least_variance;
    store_some(at.has_reading ? 1.0 / most : zero, kLanes, weight + i);
    product *= at.has_reading ? least * unit : one;
    if (step % (kSafeProducts / 2) == 0) flush(product, wide);
  }
  flush(product, wide);
  return wide;
}

VOUSSOIR_FOR_EVERY_PROCESSOR
void collect(const PlaceArrays& arrays, const SearchIndex& index, std::size_t first, std::size_t last,
             double* weight, WideProduct* product) {
  for (std::size_t i = 0; first + i < last; ++i)
    product[i] = variances_in(arrays, box_of(index, first + i), weight + i * index.places);
}

/// True if both have the same box variances.
bool same_but_for_readings(const PlaceArrays& one, const PlaceArrays& other) {
  const auto both = [](double a, double b) { return std::isnan(a) == std::isnan(b); };
  return std::ranges::equal(one.reading, other.reading, both) && one.slope == other.slope &&
         one.offset == other.offset && one.intact == other.intact && one.origin == other.origin &&
         one.own_variance == other.own_variance && one.share_square == other.share_square &&
         one.common_square == other.common_square && one.inverse_unit == other.inverse_unit &&
         one.readings == other.readings && one.points == other.points;
}

}  // namespace

BoxVariances box_variances(const PlaceArrays& arrays, const SearchIndex& index, std::size_t first,
                           std::size_t last) {
  std::vector<WideProduct> products(last - first);
  BoxVariances boxes{first, std::vector<double>((last - first) * index.places),
                     std::vector<double>(last - first)};
  collect(arrays, index, first, last, boxes.weight.data(), products.data());
  for (std::size_t i = 0; i < products.size(); ++i) boxes.highest[i] = -0.5 * logarithm_of(products[i]);
  return boxes;
}

std::shared_ptr<const BoxVariances> KeptBoxVariances::find(const PlaceArrays& arrays,
                                                           const SearchIndex& index) {
  if (index.clusters() * index.places > kMostKept) return nullptr;
  const std::scoped_lock lock(mutex_);
  if (kept_for_ && same_but_for_readings(arrays, *kept_for_)) return kept_;
  if (!asked_ || !same_but_for_readings(arrays, *asked_)) {
    asked_ = arrays;
    return nullptr;
  }
  kept_ = std::make_shared<const BoxVariances>(box_variances(arrays, index, 0, index.clusters()));
  kept_for_ = std::exchange(asked_, std::nullopt);
  return kept_;
}

}  // namespace voussoir
