#include "lookup/evidence/gaussian_screen.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/fetch.h"
#include "core/parts.h"
#include "lookup/evidence/box_variances.h"
#include "lookup/evidence/evidence.h"
#include "lookup/evidence/index_box.h"
#include "lookup/evidence/scene_evidence.h"

namespace voussoir {
namespace {

constexpr std::size_t kPlacesTried = 20;     // after which hopeless boxes are left
constexpr std::size_t kPlacesAtOnce = 16;    // of a row, after which hopeless ones are left
constexpr std::size_t kClustersAtOnce = 64;  // whose variances stay near
constexpr std::size_t kClustersOfAThread = 1024;
static_assert(kPlacesTried % kLanes == 0 && kPlacesAtOnce % kLanes == 0);

struct Question {
  const PlaceArrays& arrays;
  const SceneTable& table;
  const SearchIndex& index;
  const RowPriors& priors;
  double shared;  // of the logarithm of all densities, in the arrays' unit
  double least;   // that matters
};

/// A row that may matter.
struct OpenRow {
  std::size_t row;
  double sum;   // of the squares of its errors so far
  double most;  // that the whole sum may be
};

/// Zero where there is no reading, NaN where a reading has no prediction.
VOUSSOIR_INLINE DoubleLanes weighted_squares(const DoubleLanes& reading, const DoubleLanes& error,
                                             const double* weight) {
  return reading == reading ? error * error * load<DoubleLanes>(weight) : DoubleLanes{};
}

/// What some places from the i-th have at least in a box.
VOUSSOIR_INLINE DoubleLanes box_squares(const PlaceArrays& arrays, const ClusterBox& box,
                                        const double* weight, std::size_t i) {
  const auto reading = load<DoubleLanes>(arrays.reading.data() + i);
  return weighted_squares(reading, least_error(reading, box.low(i), box.high(i)), weight + i);
}

/// True if no row of the box has so small a sum of squares.
VOUSSOIR_INLINE bool is_beyond(const PlaceArrays& arrays, const ClusterBox& box, const double* weight,
                               double most) {
  DoubleLanes sum{};
  for (std::size_t i = 0; i < arrays.reading.size(); i += kLanes) {
    sum += box_squares(arrays, box, weight, i);
    if (i + kLanes == kPlacesTried && sum_of(sum) > most) return true;
  }
  return sum_of(sum) > most;
}

VOUSSOIR_INLINE DoubleLanes row_squares(const PlaceArrays& arrays, const double* row, const double* weight,
                                        std::size_t i, std::size_t some) {
  const auto reading = load<DoubleLanes>(arrays.reading.data() + i);
  return weighted_squares(reading, reading - load_some<DoubleLanes>(row + i, some, 0.0), weight + i);
}

/// Fetches the next places of a row: rows come from memory in an order of their own, and begin anywhere in a
/// line of the cache.
VOUSSOIR_INLINE void fetch_places(const double* places) {
  constexpr std::size_t kLine = 64 / sizeof(double);
  fetch(std::span(places, kPlacesAtOnce + kLine));
}

/// Writes down the rows of a cluster that may matter, none of whose densities' logarithms is above `highest`,
/// and returns how many there are.
VOUSSOIR_INLINE std::size_t open_rows(const Question& q, std::size_t cluster, double highest, OpenRow* open) {
  std::size_t count = 0;
  for (const std::int32_t slot : q.index.row.subspan(q.index.slot(cluster), q.index.rows(cluster))) {
    const auto row = static_cast<std::size_t>(slot);
    open[count] = {row, 0.0, 2.0 * (highest + q.priors.row[row] - q.least)};
    fetch_places(q.table.row(row).data());
    count += open[count].most >= 0.0 ? 1 : 0;
  }
  return count;
}

/// Adds the squares of some places and keeps the rows that still may matter. Which do is as good as random:
/// there is no branch that could be guessed wrongly.
VOUSSOIR_INLINE std::size_t keep_within(const Question& q, const double* weight, std::size_t first,
                                        std::size_t last, OpenRow* open, std::size_t count) {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < count; ++k) {
    OpenRow one = open[k];
    const double* row = q.table.row(one.row).data();
    fetch_places(row + last);
    DoubleLanes sum{};
    for_lanes(last - first, [&](std::size_t i, std::size_t some) VOUSSOIR_INLINE_WORK {
      sum += row_squares(q.arrays, row, weight, first + i, some);
    });
    one.sum += sum_of(sum);
    open[kept] = one;
    kept += one.sum <= one.most ? 1 : 0;
  }
  return kept;
}

/// Finds rows of the clusters from `first` to before `last`.
VOUSSOIR_FOR_EVERY_PROCESSOR
void find_rows(const Question& q, const BoxVariances& boxes, std::size_t first, std::size_t last,
               OpenRow* open, std::vector<std::size_t>& found) {
  for (std::size_t cluster = first; cluster < last; ++cluster) {
    const double highest = q.shared + boxes.highest[cluster - boxes.first];
    const double* weight = boxes.weight.data() + (cluster - boxes.first) * q.index.places;
    const double most = 2.0 * (highest + q.priors.cluster[cluster] - q.least);
    if (!(most >= 0.0) || is_beyond(q.arrays, box_of(q.index, cluster), weight, most)) continue;
    std::size_t count = open_rows(q, cluster, highest, open);
    for (std::size_t place = 0; place < q.table.points && count > 0; place += kPlacesAtOnce)
      count = keep_within(q, weight, place, std::min(place + kPlacesAtOnce, q.table.points), open, count);
    for (std::size_t k = 0; k < count; ++k) found.push_back(open[k].row);
  }
}

/// The same; variances that are not kept are made a few boxes at a time.
std::vector<std::size_t> find_rows(const Question& q, const BoxVariances* kept, std::size_t first,
                                   std::size_t last) {
  std::size_t most_rows = 0;
  for (std::size_t cluster = first; cluster < last; ++cluster)
    most_rows = std::max(most_rows, q.index.rows(cluster));
  std::vector<OpenRow> open(most_rows);
  std::vector<std::size_t> found;
  if (kept != nullptr) {
    find_rows(q, *kept, first, last, open.data(), found);
    return found;
  }
  for (; first < last; first += kClustersAtOnce) {
    const std::size_t end = std::min(first + kClustersAtOnce, last);
    find_rows(q, box_variances(q.arrays, q.index, first, end), first, end, open.data(), found);
  }
  return found;
}

}  // namespace

bool gaussian_screen_applies(const Observation& observation) {
  return observation.noise.shape == NoiseShape::gaussian && !observation.unknown_level &&
         !observation.has_levelling() && observation.unknown_scale == 0.0;
}

std::vector<std::size_t> GaussianScreen::rows_in_reach(const Observation& observation,
                                                       const RowPriors& priors, double least) const {
  const ErrorScales scales = scales_at(observation, stated_level(observation));
  const PlaceArrays arrays(observation, scales, index_.places);
  const auto count = static_cast<double>(observation.count);
  const double shared = -count * (0.5 * std::log(2.0 * std::numbers::pi) + std::log(scales.unit));
  const double safe = least - kLogRoundOff * (1.0 + std::abs(least));
  const Question question{arrays, table_, index_, priors, shared, safe};
  const auto kept = kept_.find(arrays, index_);
  std::vector<std::vector<std::size_t>> found(parts_of(index_.clusters(), kClustersOfAThread));
  for_parts(index_.clusters(), kClustersOfAThread,
            [&](std::size_t part, std::size_t first, std::size_t clusters) {
              found[part] = find_rows(question, kept.get(), first, first + clusters);
            });
  std::vector<std::size_t> all;
  for (const std::vector<std::size_t>& rows : found) all.insert(all.end(), rows.begin(), rows.end());
  return all;
}

}  // namespace voussoir
