#include "database/search/nearest_trees.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <flann/flann.hpp>
#include <limits>

#include "core/error.h"
#include "database/format/field_codec.h"

namespace voussoir {
namespace {

constexpr unsigned kSeed = 1;  // of FLANN's own generator
constexpr int kBranches = 32;  // FLANN's default
constexpr int kRounds = 4;     // of k-means; more make no difference to what is found
constexpr float kBoundaries =
    0.2F;                          // weight of a cluster's spread when branches are ordered; FLANN's default
constexpr double kFarthest = 1e9;  // [m]
constexpr std::size_t kChecksum = sizeof(std::uint32_t);

/// The L1 norm over the points that have a reading; rows that lack one of them are farther than all others.
struct NormOfReadings {
  using is_kdtree_distance = bool;
  using ElementType = double;
  using ResultType = double;

  explicit NormOfReadings(const double* const* query) : readings(query) {}

  const double* const*
      readings;  // of the query; FLANN hands them over first against clusters, second against rows

  double operator()(const double* first, const double* second, std::size_t size) const {
    const double sum = plain_sum(first, second, size);
    return std::isnan(sum) ? sum_of_readings(first, second, size) : sum;
  }

 private:
  static double plain_sum(const double* first, const double* second, std::size_t size) {
    double sums[4] = {};
    for (std::size_t i = 0; i + 4 <= size; i += 4)
      for (std::size_t k = 0; k < 4; ++k) sums[k] += std::abs(first[i + k] - second[i + k]);
    for (std::size_t i = size / 4 * 4; i < size; ++i) sums[0] += std::abs(first[i] - second[i]);
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
  }

  double sum_of_readings(const double* first, const double* second, std::size_t size) const {
    double sum = 0.0;
    bool lacks = false;
    for (std::size_t i = 0; i < size; ++i) {
      const double difference = std::abs(first[i] - second[i]);
      sum += std::isnan(difference) ? 0.0 : difference;
      lacks |= std::isnan(first[i]) && !std::isnan(second[i]);
    }
    return lacks && second == *readings ? kFarthest : sum;
  }
};

using Trees = flann::KMeansIndex<NormOfReadings>;

flann::Matrix<double> matrix(std::span<const double> rows, std::size_t points) {
  return {const_cast<double*>(rows.data()), rows.size() / points, points};  // FLANN does not write into it
}

flann::KMeansIndexParams parameters() {
  return {kBranches, kRounds, flann::FLANN_CENTERS_GONZALES, kBoundaries};
}

struct Closed {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using Stream = std::unique_ptr<std::FILE, Closed>;

Bytes saved(Trees& trees) {
  char* text = nullptr;
  std::size_t size = 0;
  Stream stream(::open_memstream(&text, &size));
  if (!stream) throw Failure("no memory for the nearest-neighbour trees");
  trees.saveIndex(stream.get());
  stream.reset();
  const auto* const bytes = reinterpret_cast<const std::byte*>(text);
  Bytes result(bytes, bytes + size);
  std::free(text);
  return result;
}

}  // namespace

Bytes build_nearest_trees(std::span<const double> rows, std::size_t points) {
  std::vector<double> filled(rows.begin(), rows.end());
  for (std::size_t i = 0; i < filled.size(); ++i) {
    if (!std::isfinite(filled[i])) filled[i] = filled[i % points];
    if (!std::isfinite(filled[i])) filled[i] = 0.0;
    filled[i] = std::clamp(filled[i], -kFarthest, kFarthest);  // damaged ones must not overflow
  }
  flann::seed_random(kSeed);
  const double* const no_query = nullptr;
  Trees trees(matrix(filled, points), parameters(), NormOfReadings(&no_query));
  trees.buildIndex();
  const Bytes content = saved(trees);
  const std::uint32_t checksum = crc32_of(content);
  Bytes result(kChecksum);
  std::memcpy(result.data(), &checksum, kChecksum);
  result.insert(result.end(), content.begin(), content.end());
  return result;
}

struct NearestTrees::Implementation {
  std::span<const double> rows;
  std::size_t points;
  const double* readings = nullptr;  // of the query under way
  Trees trees;

  Implementation(std::span<const double> all, std::size_t columns)
      : rows(all), points(columns), trees(matrix(all, columns), parameters(), NormOfReadings(&readings)) {}
};

NearestTrees::NearestTrees(ByteView stored, std::span<const double> rows, std::size_t points,
                           std::span<const std::size_t> wanted)
    : implementation_(std::make_unique<Implementation>(rows, points)) {
  std::uint32_t checksum = 0;
  if (stored.size() <= kChecksum)
    throw InputError("the nearest-neighbour trees are empty, build the database again");
  std::memcpy(&checksum, stored.data(), kChecksum);
  stored = stored.subspan(kChecksum);
  if (checksum != crc32_of(stored))
    throw InputError("the nearest-neighbour trees are damaged, build the database again");
  const Stream stream(::fmemopen(const_cast<std::byte*>(stored.data()), stored.size(), "rb"));
  if (!stream) throw Failure("no memory for the nearest-neighbour trees");
  try {
    implementation_->trees.loadIndex(stream.get());
  } catch (const flann::FLANNException& error) {
    throw InputError(fmt::format("the nearest-neighbour trees cannot be read: {}", error.what()));
  }
  auto next = wanted.begin();
  for (std::size_t row = 0; row < rows.size() / points; ++row)
    if (next != wanted.end() && *next == row)
      ++next;
    else
      implementation_->trees.removePoint(row);
}
NearestTrees::~NearestTrees() = default;
NearestTrees::NearestTrees(NearestTrees&&) noexcept = default;
NearestTrees& NearestTrees::operator=(NearestTrees&&) noexcept = default;

std::vector<Neighbour> NearestTrees::nearest(std::span<const double> readings, std::size_t count,
                                             int checks) const {
  std::vector<double> query(readings.begin(), readings.end());
  implementation_->readings = query.data();
  std::vector<std::vector<std::size_t>> found;
  std::vector<std::vector<double>> distances;
  implementation_->trees.knnSearch(flann::Matrix<double>(query.data(), 1, query.size()), found, distances,
                                   count, flann::SearchParams(checks));
  std::vector<Neighbour> result;
  for (std::size_t i = 0; i < found.front().size(); ++i)
    if (distances.front()[i] < kFarthest) result.push_back({found.front()[i], distances.front()[i]});
  return result;
}

}  // namespace voussoir
