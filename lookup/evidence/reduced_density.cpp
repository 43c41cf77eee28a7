#include "lookup/evidence/reduced_density.h"

#include "core/simd/lane_math.h"
#include "lookup/evidence/reduced_factorisation.h"
#include "lookup/evidence/scene_evidence.h"

namespace voussoir {
namespace {

constexpr std::size_t kWidth = kDirections;
constexpr auto kFirstWidth = static_cast<std::size_t>(kFirstColumns);
static_assert(kFirstWidth % kLanes == 0 && kEpochColumns % kLanes == 0);

using Scenes = std::span<const ScenePrediction, kLanes>;

/// Numbers of four scenes, one after the other, as lanes.
VOUSSOIR_INLINE void transpose(DoubleLanes (&rows)[kLanes]) {
  const DoubleLanes a = __builtin_shufflevector(rows[0], rows[1], 0, 4, 2, 6),
                    b = __builtin_shufflevector(rows[0], rows[1], 1, 5, 3, 7),
                    c = __builtin_shufflevector(rows[2], rows[3], 0, 4, 2, 6),
                    d = __builtin_shufflevector(rows[2], rows[3], 1, 5, 3, 7);
  rows[0] = __builtin_shufflevector(a, c, 0, 1, 4, 5);
  rows[1] = __builtin_shufflevector(b, d, 0, 1, 4, 5);
  rows[2] = __builtin_shufflevector(a, c, 2, 3, 6, 7);
  rows[3] = __builtin_shufflevector(b, d, 2, 3, 6, 7);
}

/// What no case changes of the scenes' Gaussians, in some of the directions.
struct ReducedScenes {
  DoubleLanes signal[kWidth];
  DoubleLanes beyond[kWidth];  // of it what is not that of its losses
  DoubleLanes mean_square;     // of that over the channels read; NaN: the scene is impossible
  DoubleLanes bridge[lower_size(kWidth)], epoch[lower_size(kWidth)], model_error[lower_size(kWidth)];
  DoubleLanes loose[lower_size(kWidth)];  // what a spread of 1 of the signal beyond its losses adds
};

/// Some numbers of each scene's losses, summed up over them.
template <std::size_t kCount, class Numbers>
VOUSSOIR_INLINE void add_up(Scenes scenes, std::size_t count, Numbers numbers, DoubleLanes* sums) {
  for (std::size_t at = 0; at < count; at += kLanes) {
    DoubleLanes rows[kLanes];
    for (std::size_t k = 0; k < kLanes; ++k) {
      rows[k] = numbers(*scenes[k].losses[0], at);
      for (std::size_t l = 1; l < kCount; ++l) rows[k] += numbers(*scenes[k].losses[l], at);
    }
    transpose(rows);
    for (std::size_t k = 0; k < kLanes; ++k) sums[at + k] = rows[k];
  }
}

/// Signals by channel, and the mean square of what they are beyond those of the losses.
template <std::size_t kCount>
VOUSSOIR_INLINE void subtract_intact(const ReducedQuestion& q, Scenes scenes, DoubleLanes* signals,
                                     ReducedScenes& to) {
  DoubleLanes squares[kLanes] = {};
  for (std::size_t at = 0; at < q.points_of_rows; at += kLanes) {
    const std::size_t count = smaller(kLanes, q.points_of_rows - at);
    const DoubleLanes intact = load<DoubleLanes>(q.intact + at), is_read = load<DoubleLanes>(q.is_read + at);
    DoubleLanes rows[kLanes];
    for (std::size_t k = 0; k < kLanes; ++k) {
      const DoubleLanes shown = load_some<DoubleLanes>(scenes[k].prediction + at, count, 0.0);
      rows[k] = is_read > 0.0 ? shown - intact : DoubleLanes{};
      DoubleLanes beyond = rows[k];
      for (std::size_t l = 0; l < kCount; ++l)
        beyond -= load<DoubleLanes>(scenes[k].losses[l]->signal_of_channels.data() + at);
      squares[k] += beyond * beyond;
    }
    transpose(rows);
    for (std::size_t k = 0; k < kLanes; ++k) signals[at + k] = rows[k];
  }
  transpose(squares);
  to.mean_square = ((squares[0] + squares[1]) + (squares[2] + squares[3])) / q.read;
}

/// In the first N directions, some at a time, whose sums stay in registers.
template <std::size_t N, std::size_t kCount>
VOUSSOIR_INLINE void project(const ReducedQuestion& q, Scenes scenes, DoubleLanes* signals,
                             ReducedScenes& to) {
  constexpr std::size_t kTogether = N < 8 ? N : 8;
  subtract_intact<kCount>(q, scenes, signals, to);
  for (std::size_t first = 0; first < N; first += kTogether) {
    DoubleLanes sums[kTogether] = {};
    for (std::size_t k = 0; k < q.points_of_rows; ++k)
      for (std::size_t i = 0; i < kTogether; ++i)
        sums[i] += signals[k] * q.directions[k * kWidth + first + i];
    for (std::size_t i = 0; i < kTogether; ++i) to.signal[first + i] = sums[i];
  }
  const auto signal = [](const ReducedLoss& loss, std::size_t at)
                          VOUSSOIR_INLINE_WORK { return load<DoubleLanes>(loss.signal.data() + at); };
  add_up<kCount>(scenes, N, signal, to.beyond);
  for (std::size_t i = 0; i < N; ++i) to.beyond[i] = to.signal[i] - to.beyond[i];
}

template <std::size_t kColumns>
VOUSSOIR_INLINE void add_products(const DoubleLanes* columns, std::size_t rows, DoubleLanes* lower) {
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j <= i; ++j, ++lower)
      for (std::size_t p = 0; p < kColumns; ++p)
        *lower += columns[i * kColumns + p] * columns[j * kColumns + p];
}

/// Adds the products of columns of each scene, the sums of its losses'.
template <std::size_t N, std::size_t kCount, std::size_t kColumns, class Numbers>
VOUSSOIR_INLINE void add_columns(Scenes scenes, Numbers numbers, DoubleLanes* lower) {
  DoubleLanes columns[N * kColumns];
  add_up<kCount>(scenes, N * kColumns, numbers, columns);
  add_products<kColumns>(columns, N, lower);
}

/// The triangles of the first N directions.
template <std::size_t N, std::size_t kCount>
VOUSSOIR_INLINE void fill(const ReducedQuestion& q, Scenes scenes, ReducedScenes& to) {
  const auto part = [](ReducedPart ReducedLoss::*of) VOUSSOIR_INLINE_WORK {
    return [of](const ReducedLoss& loss, std::size_t at) VOUSSOIR_INLINE_WORK {
      return load<DoubleLanes>((loss.*of).crossed.data() + at) +
             static_cast<double>(kCount) * load<DoubleLanes>((loss.*of).own.data() + at);
    };
  };
  constexpr std::size_t kSize = lower_size(N);
  add_up<kCount>(scenes, kSize, part(&ReducedLoss::of_bridge), to.bridge);
  for (std::size_t at = 0; at < kSize; ++at) to.bridge[at] += q.bridge[at];
  add_columns<N, kCount, kFirstWidth>(
      scenes,
      [](const ReducedLoss& loss, std::size_t at)
          VOUSSOIR_INLINE_WORK { return load<DoubleLanes>(loss.first.data() + at); },
      to.bridge);
  add_up<kCount>(scenes, kSize, part(&ReducedLoss::of_epoch), to.epoch);
  add_columns<N, kCount, kEpochColumns>(
      scenes,
      [](const ReducedLoss& loss, std::size_t at)
          VOUSSOIR_INLINE_WORK { return load<DoubleLanes>(loss.epoch.data() + at); },
      to.epoch);
  add_up<kCount>(
      scenes, kSize,
      [](const ReducedLoss& loss, std::size_t at)
          VOUSSOIR_INLINE_WORK { return load<DoubleLanes>(loss.model_error.data() + at); },
      to.model_error);
  std::size_t at = 0;
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = 0; j <= i; ++j, ++at)
      to.loose[at] = to.beyond[i] * to.beyond[j] + to.mean_square * q.points[at];
}

/// What a case adds to kappa A A^T in the first N directions.
template <std::size_t N>
VOUSSOIR_INLINE void fill_noise(const ReducedCase& one, const ReducedScenes& scenes, DoubleLanes* noise) {
  for (std::size_t at = 0; at < lower_size(N); ++at)
    noise[at] = one.others[at] + one.epoch_factor * scenes.epoch[at] + one.spread_square * scenes.loose[at] +
                scenes.model_error[at];
}

/// A case's log densities of four scenes in the first N directions, kappa marginalised. Those that do not
/// matter in any scene are their bounds, the largest of all kappa.
template <std::size_t N>
VOUSSOIR_INLINE DoubleLanes over_kappa(const ReducedQuestion& q, const ReducedCase& one,
                                       const ReducedScenes& scenes, const ScatterLogs& outside,
                                       const DoubleLanes& least) {
  DoubleLanes noise[lower_size(N)], difference[N], logs[kScatterFactors.size()];
  fill_noise<N>(one, scenes, noise);
  for (std::size_t i = 0; i < N; ++i) difference[i] = q.reading[i] - scenes.signal[i];
  DoubleLanes largest = DoubleLanes{} + kImpossible, sum{};
  Factorisation<N> factorisation;
  factorisation.noise = noise;
  factorisation.bridge = scenes.bridge;
  for (std::size_t k = 0; k < kScatterFactors.size(); ++k) {
    factorisation.kappa = kScatterFactors[k];
    factorisation.factorise();
    logs[k] = outside[k] - 0.5 * (factorisation.log_determinant + factorisation.square_of(difference));
    largest = larger(largest, logs[k]);
    sum += logs[k];
  }
  largest = sum == sum ? largest : sum;  // NaN stays
  if (!any(largest >= least)) return largest;
  sum = DoubleLanes{};
  for (std::size_t k = 0; k < kScatterFactors.size(); ++k) {
    logs[k] -= largest;
    make_exponential(logs[k]);
    sum += kScatterPrior[k] * logs[k];
  }
  make_logarithm(sum);
  return largest + sum;
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
VOUSSOIR_INLINE void look(const ReducedQuestion& q, Scenes scenes, const Rises& rises, DoubleLanes* signals) {
  constexpr auto N = static_cast<std::size_t>(ScreenDirections::first);
  ReducedScenes reduced;
  DoubleLanes least{}, bounds{};
  bool is_filled = false;
  for (std::size_t i = 0; i < kLanes; ++i) least[i] = scenes[i].least;
  for (std::size_t k = 0; k < q.cases.size(); ++k) {
    const ReducedCase& one = q.cases[k];
    for (std::size_t i = 0; i < kLanes; ++i)
      bounds[i] = bound_of(one, scenes[i].logs, rises.of + k * rises.all, rises.before + k);
    DoubleLanes logs = bounds;
    if (any(bounds >= least)) {
      if (!is_filled) project<N, kCount>(q, scenes, signals, reduced), fill<N, kCount>(q, scenes, reduced);
      is_filled = true;
      logs = over_kappa<N>(q, one, reduced, one.outside.front(), least);
      logs = reduced.mean_square == reduced.mean_square ? logs : DoubleLanes{} + kImpossible;
      logs = bounds < least ? bounds : logs;
    }
    for (std::size_t i = 0; i < kLanes; ++i) scenes[i].logs[rises.before + k] = logs[i];
  }
}

template <std::size_t N, std::size_t kCount>
VOUSSOIR_INLINE void look_closer(const ReducedQuestion& q, Scenes scenes, std::size_t place,
                                 DoubleLanes* signals) {
  ReducedScenes reduced;
  DoubleLanes least{}, before{};
  bool is_filled = false;
  for (std::size_t i = 0; i < kLanes; ++i) least[i] = scenes[i].least;
  for (std::size_t k = 0; k < q.cases.size(); ++k) {
    for (std::size_t i = 0; i < kLanes; ++i) before[i] = scenes[i].logs[k];
    if (!any((before < least ? DoubleLanes{} + kImpossible : before) != kImpossible)) continue;
    if (!is_filled) project<N, kCount>(q, scenes, signals, reduced), fill<N, kCount>(q, scenes, reduced);
    is_filled = true;
    const DoubleLanes refined = over_kappa<N>(q, q.cases[k], reduced, q.cases[k].outside[place], least);
    before = refined < before ? refined : before;  // NaN changes nothing
    for (std::size_t i = 0; i < kLanes; ++i) scenes[i].logs[k] = before[i];
  }
}

VOUSSOIR_FOR_EVERY_PROCESSOR
void look_at(const ReducedQuestion& q, Scenes scenes, std::size_t losses, const Rises& rises,
             DoubleLanes* signals) {
  if (losses == 1) look<1>(q, scenes, rises, signals);
  if (losses == 2) look<2>(q, scenes, rises, signals);
  if (losses == 3) look<3>(q, scenes, rises, signals);
}

VOUSSOIR_FOR_EVERY_PROCESSOR
void look_in_few(const ReducedQuestion& q, Scenes scenes, std::size_t losses, DoubleLanes* signals) {
  if (losses == 1) look_closer<8, 1>(q, scenes, 1, signals);
  if (losses == 2) look_closer<8, 2>(q, scenes, 1, signals);
  if (losses == 3) look_closer<8, 3>(q, scenes, 1, signals);
}

VOUSSOIR_FOR_EVERY_PROCESSOR
void look_in_more(const ReducedQuestion& q, Scenes scenes, std::size_t losses, DoubleLanes* signals) {
  if (losses == 1) look_closer<16, 1>(q, scenes, 2, signals);
  if (losses == 2) look_closer<16, 2>(q, scenes, 2, signals);
  if (losses == 3) look_closer<16, 3>(q, scenes, 2, signals);
}

VOUSSOIR_FOR_EVERY_PROCESSOR
void look_in_all(const ReducedQuestion& q, Scenes scenes, std::size_t losses, DoubleLanes* signals) {
  if (losses == 1) look_closer<32, 1>(q, scenes, 3, signals);
  if (losses == 2) look_closer<32, 2>(q, scenes, 3, signals);
  if (losses == 3) look_closer<32, 3>(q, scenes, 3, signals);
}

/// Memory of one thread for signals by channel.
DoubleLanes* memory_for(std::size_t channels) {
  thread_local LaneVector signals;
  signals.resize(std::max(signals.size(), padded(channels)));
  return registers_of(signals);
}

}  // namespace

void estimate_log_densities(const ReducedQuestion& question, Scenes scenes, std::size_t losses,
                            const Eigen::MatrixXd& rises, std::size_t before) {
  look_at(question, scenes, losses, {rises.data(), static_cast<std::size_t>(rises.rows()), before},
          memory_for(question.points_of_rows));
}

void refine_log_densities(const ReducedQuestion& question, Scenes scenes, std::size_t losses,
                          ScreenDirections directions) {
  DoubleLanes* const signals = memory_for(question.points_of_rows);
  if (directions == ScreenDirections::few) look_in_few(question, scenes, losses, signals);
  if (directions == ScreenDirections::more) look_in_more(question, scenes, losses, signals);
  if (directions == ScreenDirections::all) look_in_all(question, scenes, losses, signals);
}

}  // namespace voussoir
