#include "lookup/evidence/reduced_density.h"

#include "core/simd/lane_math.h"
#include "lookup/evidence/scatter_factorisation.h"
#include "lookup/evidence/scene_evidence.h"

namespace voussoir {
namespace {

constexpr std::size_t kWidth = kDirections;
constexpr auto kFirstWidth = static_cast<std::size_t>(kFirstColumns);
static_assert(kWidth % kLanes == 0 && kFirstDirections % kLanes == 0 && kMoreDirections % kLanes == 0 &&
              kFirstWidth % kLanes == 0 && kEpochColumns % kLanes == 0);

template <std::size_t kCount>
using Losses = std::span<const ReducedLoss* const, kCount>;

/// What no case changes of a scene's Gaussian, in some of the directions.
struct ReducedScene {
  double signal[kWidth];
  double beyond[kWidth];     // of it what is not that of its losses
  double mean_square = 0.0;  // of that in rows of y; NaN: the scene is impossible
  double bridge[lower_size(kWidth)], epoch[lower_size(kWidth)], model_error[lower_size(kWidth)];
  double loose[lower_size(kWidth)];  // what a spread of 1 of the signal beyond its losses adds
};

/// In the first N directions. Even and odd rows are summed up by themselves, as sums wait for each other.
template <std::size_t N, std::size_t kCount>
VOUSSOIR_INLINE void project(const ReducedQuestion& q, const double* prediction, Losses<kCount> losses,
                             ReducedScene& to) {
  constexpr std::size_t kParts = N / kLanes;
  DoubleLanes sums[2][kParts] = {};
  double squares[2] = {};
  for (std::size_t first = 0; first < q.rows; first += 2)
    for (std::size_t k = first; k < smaller(first + 2, q.rows); ++k) {
      const std::size_t channel = q.channel[k];
      const double signal = q.after[k] == 0.0 ? 0.0 : q.after[k] * (prediction[channel] - q.intact[channel]);
      double beyond = signal;
      for (const ReducedLoss* loss : losses) beyond -= loss->signal_of_rows[k];
      squares[k - first] += beyond * beyond;
      for (std::size_t i = 0; i < kParts; ++i)
        sums[k - first][i] += signal * load<DoubleLanes>(q.directions + k * kWidth + i * kLanes);
    }
  for (std::size_t i = 0; i < kParts; ++i)
    store_some(sums[0][i] + sums[1][i], kLanes, to.signal + i * kLanes);
  for (std::size_t i = 0; i < N; ++i) {
    to.beyond[i] = to.signal[i];
    for (const ReducedLoss* loss : losses) to.beyond[i] -= loss->signal[i];
  }
  to.mean_square = (squares[0] + squares[1]) / q.changed;
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

/// The triangles of the first N directions.
template <std::size_t N, std::size_t kCount>
VOUSSOIR_INLINE void fill(const ReducedQuestion& q, Losses<kCount> losses, ReducedScene& to) {
  double first[N * kFirstWidth], epochs[N * kEpochColumns];
  add_up<N, kFirstWidth>(losses, &ReducedLoss::first, first);
  add_up<N, kEpochColumns>(losses, &ReducedLoss::epoch, epochs);
  for (std::size_t at = 0; at < lower_size(N); at += kLanes) {
    DoubleLanes bridge = load<DoubleLanes>(q.bridge + at), epoch{}, model_error{};
    for (const ReducedLoss* loss : losses) {
      const auto add = [&](const ReducedPart& part, DoubleLanes& sum) __attribute__((always_inline)) {
        sum += load<DoubleLanes>(part.crossed.data() + at) +
               static_cast<double>(kCount) * load<DoubleLanes>(part.own.data() + at);
      };
      add(loss->of_bridge, bridge);
      add(loss->of_epoch, epoch);
      model_error += load<DoubleLanes>(loss->model_error.data() + at);
    }
    store_some(bridge, kLanes, to.bridge + at);
    store_some(epoch, kLanes, to.epoch + at);
    store_some(model_error, kLanes, to.model_error + at);
  }
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      const std::size_t at = lower_size(i) + j;
      to.bridge[at] += product<kFirstWidth>(first, i, j);
      to.epoch[at] += product<kEpochColumns>(epochs, i, j);
      to.loose[at] = to.beyond[i] * to.beyond[j] + to.mean_square * q.points[at];
    }
}

/// What a case adds to kappa A A^T in the first N directions.
template <std::size_t N>
VOUSSOIR_INLINE void fill_noise(const ReducedCase& one, const ReducedScene& scene, double* noise) {
  for (std::size_t at = 0; at < lower_size(N); at += kLanes)
    store_some(load<DoubleLanes>(one.others.data() + at) +
                   one.epoch_factor * load<DoubleLanes>(scene.epoch + at) +
                   one.spread_square * load<DoubleLanes>(scene.loose + at) +
                   load<DoubleLanes>(scene.model_error + at),
               kLanes, noise + at);
}

/// -(log det + quadratic form) / 2 in the first N directions.
template <std::size_t N>
VOUSSOIR_INLINE DoubleLanes log_density(const ReducedQuestion& q, const ReducedCase& one,
                                        const ReducedScene& scene) {
  double noise[lower_size(N)], difference[N], pivots[N * kLanes];
  DoubleLanes factor[lower_size(N) + N], inverse[N];
  fill_noise<N>(one, scene, noise);
  for (std::size_t i = 0; i < N; ++i) difference[i] = q.reading[i] - scene.signal[i];
  const DoubleLanes squares =
      factorise_inline({N, difference, noise, scene.bridge, load<DoubleLanes>(kScatterFactors.data()), factor,
                        inverse, pivots});
  DoubleLanes logs{};
  for (std::size_t i = 0; i < N; i += kLanes) {
    DoubleLanes product = load<DoubleLanes>(pivots + i * kLanes);
    for (std::size_t k = 1; k < kLanes; ++k) product *= load<DoubleLanes>(pivots + (i + k) * kLanes);
    make_logarithm(product);
    logs += product;
  }
  return -0.5 * (logs + squares);
}

template <std::size_t N>
VOUSSOIR_INLINE double over_kappa(const ReducedQuestion& q, const ReducedCase& one, const ReducedScene& scene,
                                  const ScatterLogs& outside) {
  DoubleLanes logs = log_density<N>(q, one, scene) + load<DoubleLanes>(outside.data());
  const double largest = largest_of(logs);
  logs -= largest;
  make_exponential(logs);
  const double sum = sum_of(logs * load<DoubleLanes>(kScatterPrior.data()));
  return largest + __builtin_log(sum);
}

/// How much the logarithm of each of `all` cases rises at most to each of the screen's, which come `before`
/// many.
struct Rises {
  const double* of;
  std::size_t all, before;
};

/// What the cases before it leave of one.
VOUSSOIR_INLINE double bound_of(const ReducedCase& one, const double* logs, const double* rises,
                                std::size_t before) {
  double bound = one.peak;
  for (std::size_t j = 0; j < before; ++j) bound = smaller(logs[j] + rises[j], bound);  // NaN does not bound
  return bound;
}

template <std::size_t kCount>
VOUSSOIR_INLINE void look(const ReducedQuestion& q, const double* prediction, Losses<kCount> losses,
                          double least, const Rises& rises, double* logs) {
  ReducedScene scene;
  bool is_filled = false;
  for (std::size_t k = 0; k < q.cases.size(); ++k) {
    const ReducedCase& one = q.cases[k];
    double& log = logs[rises.before + k];
    log = bound_of(one, logs, rises.of + k * rises.all, rises.before + k);
    if (log < least) continue;
    if (!is_filled) {
      project<kFirstDirections>(q, prediction, losses, scene);
      fill<kFirstDirections>(q, losses, scene);
      is_filled = true;
    }
    const bool is_possible = scene.mean_square == scene.mean_square;
    log = is_possible ? over_kappa<kFirstDirections>(q, one, scene, one.outside_few) : kImpossible;
  }
}

template <std::size_t N, std::size_t kCount>
VOUSSOIR_INLINE void look_closer(const ReducedQuestion& q, const double* prediction, Losses<kCount> losses,
                                 double least, ScatterLogs ReducedCase::*outside, double* logs) {
  ReducedScene scene;
  bool is_filled = false;
  for (std::size_t k = 0; k < q.cases.size(); ++k) {
    if (logs[k] < least || logs[k] == kImpossible) continue;
    if (!is_filled) {
      project<N>(q, prediction, losses, scene);
      fill<N>(q, losses, scene);
      is_filled = true;
    }
    const double refined = over_kappa<N>(q, q.cases[k], scene, q.cases[k].*outside);
    logs[k] = smaller(refined, logs[k]);  // NaN changes nothing
  }
}

VOUSSOIR_FOR_EVERY_PROCESSOR
void look_at(const ReducedQuestion& q, const ScenePrediction& scene, double least, const Rises& rises,
             double* logs) {
  const auto& losses = scene.losses;
  if (losses.size() == 1) look<1>(q, scene.prediction, losses.first<1>(), least, rises, logs);
  if (losses.size() == 2) look<2>(q, scene.prediction, losses.first<2>(), least, rises, logs);
  if (losses.size() == 3) look<3>(q, scene.prediction, losses.first<3>(), least, rises, logs);
}

VOUSSOIR_FOR_EVERY_PROCESSOR
void look_in_more(const ReducedQuestion& q, const ScenePrediction& scene, double least, double* logs) {
  constexpr std::size_t N = kMoreDirections;
  constexpr auto kOutside = &ReducedCase::outside_more;
  const auto& losses = scene.losses;
  if (losses.size() == 1) look_closer<N>(q, scene.prediction, losses.first<1>(), least, kOutside, logs);
  if (losses.size() == 2) look_closer<N>(q, scene.prediction, losses.first<2>(), least, kOutside, logs);
  if (losses.size() == 3) look_closer<N>(q, scene.prediction, losses.first<3>(), least, kOutside, logs);
}

VOUSSOIR_FOR_EVERY_PROCESSOR
void look_in_all(const ReducedQuestion& q, const ScenePrediction& scene, double least, double* logs) {
  constexpr auto kOutside = &ReducedCase::outside_all;
  const auto& losses = scene.losses;
  if (losses.size() == 1) look_closer<kWidth>(q, scene.prediction, losses.first<1>(), least, kOutside, logs);
  if (losses.size() == 2) look_closer<kWidth>(q, scene.prediction, losses.first<2>(), least, kOutside, logs);
  if (losses.size() == 3) look_closer<kWidth>(q, scene.prediction, losses.first<3>(), least, kOutside, logs);
}

}  // namespace

void estimate_log_densities(const ReducedQuestion& question, const ScenePrediction& scene, double least,
                            const Eigen::MatrixXd& rises, std::span<double> logs) {
  look_at(question, scene, least,
          {rises.data(), static_cast<std::size_t>(rises.rows()), logs.size() - question.cases.size()},
          logs.data());
}

void refine_log_densities(const ReducedQuestion& question, const ScenePrediction& scene,
                          ScreenDirections directions, double least, std::span<double> logs) {
  if (directions == ScreenDirections::more)
    look_in_more(question, scene, least, logs.data());
  else
    look_in_all(question, scene, least, logs.data());
}

}  // namespace voussoir
