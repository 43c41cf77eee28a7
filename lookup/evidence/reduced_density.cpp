#include "lookup/evidence/reduced_density.h"

#include <limits>

#include "core/simd/lane_math.h"

namespace voussoir {
namespace {

constexpr std::size_t K = kDirections;
constexpr auto kFirst = static_cast<std::size_t>(kFirstColumns);
static_assert(K % kLanes == 0 && kFirstDirections % kLanes == 0 && kFirst % kLanes == 0 &&
              kEpochColumns % kLanes == 0);
static_assert(kScatterFactors.size() == kLanes, "one lane for each");

template <std::size_t kCount>
using Losses = std::span<const ReducedLoss* const, kCount>;

/// A scene's signal in the directions, beyond that of its losses, and the mean square of the latter.
struct Projected {
  double signal[K];
  double beyond[K];
  double mean_square = 0.0;  // NaN: the scene is impossible
};

/// In directions `from` to `end`.
template <std::size_t from, std::size_t end, std::size_t kCount>
VOUSSOIR_INLINE void project(const ReducedQuestion& q, const double* prediction, Losses<kCount> losses,
                             Projected& to) {
  constexpr std::size_t kParts = (end - from) / kLanes;
  DoubleLanes sums[kParts] = {};
  double squares = 0.0;
  for (std::size_t k = 0; k < q.rows; ++k) {
    const std::size_t channel = q.channel[k];
    const double signal = q.after[k] == 0.0 ? 0.0 : q.after[k] * (prediction[channel] - q.intact[channel]);
    double beyond = signal;
    for (const ReducedLoss* loss : losses) beyond -= loss->signal_of_rows[k];
    squares += beyond * beyond;
    for (std::size_t i = 0; i < kParts; ++i)
      sums[i] += signal * load<DoubleLanes>(q.directions + k * K + from + i * kLanes);
  }
  for (std::size_t i = 0; i < kParts; ++i) store_some(sums[i], kLanes, to.signal + from + i * kLanes);
  for (std::size_t i = from; i < end; ++i) {
    to.beyond[i] = to.signal[i];
    for (const ReducedLoss* loss : losses) to.beyond[i] -= loss->signal[i];
  }
  to.mean_square = squares / q.changed;
}

/// The sum of some columns of all losses, in the first N directions.
template <std::size_t N, std::size_t kColumns, std::size_t kCount, class Columns>
VOUSSOIR_INLINE void add_up(Losses<kCount> losses, Columns ReducedLoss::*columns, double* sums) {
  for (std::size_t i = 0; i < N * kColumns; i += kLanes) {
    DoubleLanes sum{};
    for (const ReducedLoss* loss : losses) sum += load<DoubleLanes>((loss->*columns).data() + i);
    store_some(sum, kLanes, sums + i);
  }
}

template <std::size_t kColumns>
VOUSSOIR_INLINE double product(const double* columns, std::size_t i, std::size_t j) {
  DoubleLanes sum{};
  for (std::size_t p = 0; p < kColumns; p += kLanes)
    sum += load<DoubleLanes>(columns + i * kColumns + p) * load<DoubleLanes>(columns + j * kColumns + p);
  return sum_of(sum);
}

/// The covariance in the first N directions, for all kappa side by side.
template <std::size_t N, std::size_t kCount>
VOUSSOIR_INLINE void fill(const ReducedQuestion& q, const Projected& scene, Losses<kCount> losses,
                          DoubleLanes* covariance) {
  const DoubleLanes kappa = load<DoubleLanes>(kScatterFactors.data());
  const double square = q.spread * q.spread, point = square * scene.mean_square;
  double first[N * kFirst], epoch[N * kEpochColumns];
  if constexpr (kCount > 1) {
    add_up<N, kFirst>(losses, &ReducedLoss::first, first);
    add_up<N, kEpochColumns>(losses, &ReducedLoss::epoch, epoch);
  }
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      const std::size_t at = lower_size(i) + j;
      double bridge = q.bridge[at];
      double others = q.others[at] + square * scene.beyond[i] * scene.beyond[j] + point * q.points[at];
      for (const ReducedLoss* loss : losses) {
        bridge += loss->bridge[kCount - 1][at];
        others += loss->others[kCount - 1][at];
      }
      if constexpr (kCount > 1) {
        bridge += product<kFirst>(first, i, j);
        others += product<kEpochColumns>(epoch, i, j);
      }
      covariance[at] = others + kappa * bridge;
    }
}

/// -(log det + quadratic form) / 2 in the first N directions. The covariance is lost.
template <std::size_t N>
VOUSSOIR_INLINE DoubleLanes log_density(const ReducedQuestion& q, const Projected& scene,
                                        DoubleLanes* covariance) {
  DoubleLanes squares{}, determinant = DoubleLanes{} + 1.0, logs{};
  DoubleLanes left[N];
  for (std::size_t i = 0; i < N; ++i) left[i] = DoubleLanes{} + (q.reading[i] - scene.signal[i]);
  for (std::size_t k = 0; k < N; ++k) {
    const DoubleLanes pivot = covariance[lower_size(k) + k], inverse = 1.0 / pivot;
    squares += left[k] * left[k] * inverse;
    determinant *= pivot;
    if (k % 4 == 3) {
      make_logarithm(determinant);
      logs += determinant;
      determinant = DoubleLanes{} + 1.0;
    }
    for (std::size_t i = k + 1; i < N; ++i) {
      const DoubleLanes factor = covariance[lower_size(i) + k] * inverse;
      left[i] -= factor * left[k];
      for (std::size_t j = k + 1; j <= i; ++j)
        covariance[lower_size(i) + j] -= factor * covariance[lower_size(j) + k];
    }
  }
  return -0.5 * (logs + squares);
}

template <std::size_t N, std::size_t kCount>
VOUSSOIR_INLINE double over_kappa(const ReducedQuestion& q, const Projected& scene, Losses<kCount> losses,
                                  const ScatterLogs& offset) {
  DoubleLanes covariance[lower_size(N)];
  fill<N>(q, scene, losses, covariance);
  DoubleLanes logs = log_density<N>(q, scene, covariance) + load<DoubleLanes>(offset.data());
  const double largest = largest_of(logs);
  logs -= largest;
  make_exponential(logs);
  const double sum = sum_of(logs * load<DoubleLanes>(kScatterPrior.data()));
  return largest + __builtin_log(sum);
}

template <std::size_t kCount>
VOUSSOIR_INLINE double density_of(const ReducedQuestion& q, const double* prediction, Losses<kCount> losses,
                                  double least) {
  Projected scene;
  project<0, kFirstDirections>(q, prediction, losses, scene);
  if (scene.mean_square != scene.mean_square) return -std::numeric_limits<double>::infinity();
  const double in_few = over_kappa<kFirstDirections>(q, scene, losses, q.offset_of_few);
  if (in_few < least) return in_few;
  project<kFirstDirections, K>(q, prediction, losses, scene);
  return over_kappa<K>(q, scene, losses, q.offset);
}

VOUSSOIR_FOR_EVERY_PROCESSOR
double density(const ReducedQuestion& q, const double* prediction, std::span<const ReducedLoss* const> losses,
               double least) {
  if (losses.size() == 1) return density_of<1>(q, prediction, losses.first<1>(), least);
  if (losses.size() == 2) return density_of<2>(q, prediction, losses.first<2>(), least);
  return density_of<3>(q, prediction, losses.first<3>(), least);
}

}  // namespace

double reduced_log_density(const ReducedQuestion& question, const double* prediction,
                           std::span<const ReducedLoss* const> losses, double least) {
  return density(question, prediction, losses, least);
}

}  // namespace voussoir
