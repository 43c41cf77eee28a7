#include "lookup/unknown/reduced_density.h"

#include "core/simd/lane_math.h"
#include "lookup/evidence/scene_evidence.h"
#include "lookup/unknown/reduced_factorisation.h"
#include "lookup/unknown/reduced_scenes.h"

namespace voussoir {
namespace {

template <class Lanes>
constexpr Lanes kImpossibleLanes = Lanes{} + static_cast<ElementOf<Lanes>>(kImpossible);

/// Variances and squares, in whitened readings, beside which single precision loses the instruments' errors;
/// and logarithms so far below the peak that it knows them to a unit only.
constexpr float kRoughVariance = 1e3f, kRoughSquare = 1e6f, kRoughLogarithm = 200.0f;

/// What a case adds to kappa A A^T in the first N directions.
template <class Lanes, std::size_t N>
VOUSSOIR_INLINE void fill_noise(const ReducedCase& one, const ReducedScenes<Lanes>& scenes, Lanes* noise) {
  using Number = ElementOf<Lanes>;
  const auto epoch = static_cast<Number>(one.epoch_factor), spread = static_cast<Number>(one.spread_square);
  for (std::size_t at = 0; at < lower_size(N); ++at)
    noise[at] = static_cast<Number>(one.others[at]) + epoch * scenes.epoch[at] + spread * scenes.loose[at] +
                scenes.model_error[at];
}

/// A case's log densities of the scenes in the first N directions, kappa marginalised. Those that do not
/// matter in any scene are their bounds, the largest of all kappa.
template <class Lanes, std::size_t N>
VOUSSOIR_INLINE Lanes over_kappa(const ReducedQuestion& q, const ReducedCase& one,
                                 const ReducedScenes<Lanes>& scenes, const ScatterLogs& outside,
                                 const Lanes& least) {
  using Number = ElementOf<Lanes>;
  Lanes noise[lower_size(N)], difference[N], logs[kScatterFactors.size()];
  fill_noise<Lanes, N>(one, scenes, noise);
  for (std::size_t i = 0; i < N; ++i) difference[i] = static_cast<Number>(q.reading[i]) - scenes.signal[i];
  Lanes largest = kImpossibleLanes<Lanes>, sum{};
  Factorisation<Lanes, N> factorisation;
  factorisation.noise = noise;
  factorisation.bridge = scenes.bridge;
  for (std::size_t k = 0; k < kScatterFactors.size(); ++k) {
    factorisation.kappa = static_cast<Number>(kScatterFactors[k]);
    factorisation.factorise();
    logs[k] = static_cast<Number>(outside[k]) -
              Number(0.5) * (factorisation.log_determinant() + factorisation.square_of(difference));
    largest = larger(largest, logs[k]);
    sum += logs[k];
  }
  largest = sum == sum ? largest : sum;  // NaN stays
  if (!any(largest >= least)) return largest;
  sum = Lanes{};
  for (std::size_t k = 0; k < kScatterFactors.size(); ++k) {
    logs[k] -= largest;
    make_exponential(logs[k]);
    sum += static_cast<Number>(kScatterPrior[k]) * logs[k];
  }
  make_logarithm(sum);
  return largest + sum;
}

/// Whether single precision is not enough for one of the scenes in some case: what its signal is beyond those
/// of its losses, or the variance of that, would hide all others, or scenes matter that explain nothing.
template <class Lanes>
VOUSSOIR_INLINE bool are_rough(const ReducedQuestion& q, const ReducedScenes<Lanes>& scenes,
                               const Lanes& least) {
  if constexpr (sizeof(ElementOf<Lanes>) == sizeof(double))
    return false;
  else
    return any(scenes.mean_square * q.widest_point >
               smaller(kRoughSquare, kRoughVariance / q.widest_spread)) ||
           any(least < q.highest_peak - kRoughLogarithm);
}

/// How much the logarithm of each of `all` cases rises at most to each of the screen's, which come `before`
/// many.
struct Rises {
  const double* of;
  std::size_t all, before;
};

/// Below these logarithms nothing matters.
template <class Lanes>
VOUSSOIR_INLINE Lanes least_of(Scenes<Lanes> scenes) {
  Lanes least{};
  for (std::size_t i = 0; i < scenes.size(); ++i) least[i] = static_cast<ElementOf<Lanes>>(scenes[i].least);
  return least;
}

/// Their logarithms in a case.
template <class Lanes>
VOUSSOIR_INLINE Lanes logs_of(Scenes<Lanes> scenes, std::size_t number) {
  Lanes logs{};
  for (std::size_t i = 0; i < scenes.size(); ++i) logs[i] = scenes[i].logs[number];
  return logs;
}

/// What the cases before it leave of one, whose rises from them are given; most say nothing.
template <class Lanes>
VOUSSOIR_INLINE Lanes bounds_of(const ReducedCase& one, Scenes<Lanes> scenes, const double* rises,
                                std::size_t before) {
  using Number = ElementOf<Lanes>;
  Lanes bounds = Lanes{} + static_cast<Number>(one.peak);
  for (std::size_t j = 0; j < before; ++j) {
    if (rises[j] == -kImpossible) continue;
    const Lanes bound = logs_of<Lanes>(scenes, j) + static_cast<Number>(rises[j]);
    bounds = smaller(bound, bounds);  // NaN does not bound
  }
  return bounds;
}

/// Calls work<kCount>() for scenes with so many losses. What works on factors stays outside: it would be
/// compiled three times.
template <class Work>
VOUSSOIR_INLINE void for_losses(std::size_t losses, Work work) {
  if (losses == 1) return work.template operator()<1>();
  if (losses == 2) return work.template operator()<2>();
  work.template operator()<3>();
}

template <class Lanes>
VOUSSOIR_INLINE void subtract_losses(const ReducedQuestion& q, Scenes<Lanes> scenes, std::size_t losses,
                                     Lanes* beyond, ReducedScenes<Lanes>& to) {
  for_losses(losses, [&]<std::size_t kCount>()
                         VOUSSOIR_INLINE_WORK { subtract_losses<Lanes, kCount>(q, scenes, beyond, to); });
}

/// The first N directions; kKnown of them are projected on already.
template <class Lanes, std::size_t kKnown, std::size_t N>
VOUSSOIR_INLINE void fill(const ReducedQuestion& q, Scenes<Lanes> scenes, std::size_t losses,
                          const Lanes* beyond, ReducedScenes<Lanes>& to) {
  project<Lanes, kKnown, N>(q, beyond, to);
  for_losses(losses,
             [&]<std::size_t kCount>() VOUSSOIR_INLINE_WORK { fill<Lanes, N, kCount>(q, scenes, to); });
}

/// In the first N directions, where some scene matters in a case; kKnown of them are projected on already.
/// The cases' logarithms begin at number `first`.
template <class Lanes, std::size_t kKnown, std::size_t N>
VOUSSOIR_INLINE void refine(const ReducedQuestion& q, Scenes<Lanes> scenes, std::size_t losses,
                            std::size_t first, const Lanes* beyond, ReducedScenes<Lanes>& reduced) {
  constexpr std::size_t kPlace = place_of(static_cast<ScreenDirections>(N));
  const Lanes least = least_of<Lanes>(scenes);
  bool is_filled = false;
  for (std::size_t k = 0; k < q.cases.size(); ++k) {
    const Lanes before = logs_of<Lanes>(scenes, first + k);
    if (!any((before < least ? kImpossibleLanes<Lanes> : before) != kImpossibleLanes<Lanes>)) continue;
    if (!is_filled) fill<Lanes, kKnown, N>(q, scenes, losses, beyond, reduced);
    is_filled = true;
    const Lanes refined = over_kappa<Lanes, N>(q, q.cases[k], reduced, q.cases[k].outside[kPlace], least);
    const Lanes after = refined < before ? refined : before;  // NaN changes nothing
    for (std::size_t i = 0; i < scenes.size(); ++i) scenes[i].logs[first + k] = static_cast<float>(after[i]);
  }
}

/// False, and nothing done, if the scenes are rough.
template <class Lanes>
VOUSSOIR_INLINE bool look(const ReducedQuestion& q, Scenes<Lanes> scenes, std::size_t losses,
                          const Rises& rises, Lanes* beyond) {
  constexpr auto kFew = static_cast<std::size_t>(ScreenDirections::few);
  constexpr auto N = static_cast<std::size_t>(ScreenDirections::first);
  const Lanes least = least_of<Lanes>(scenes);
  ReducedScenes<Lanes> reduced;
  bool is_filled = false;
  for (std::size_t k = 0; k < q.cases.size(); ++k) {
    const ReducedCase& one = q.cases[k];
    const Lanes bounds = bounds_of<Lanes>(one, scenes, rises.of + k * rises.all, rises.before + k);
    Lanes logs = bounds;
    if (any(bounds >= least)) {
      if (!is_filled) {
        subtract_losses<Lanes>(q, scenes, losses, beyond, reduced);
        if (are_rough(q, reduced, least)) return false;
        fill<Lanes, 0, N>(q, scenes, losses, beyond, reduced);
      }
      is_filled = true;
      logs = over_kappa<Lanes, N>(q, one, reduced, one.outside.front(), least);
      logs = logs == logs ? logs : -kImpossibleLanes<Lanes>;
      logs = reduced.mean_square == reduced.mean_square ? logs : kImpossibleLanes<Lanes>;
      logs = bounds < least ? bounds : logs;
    }
    for (std::size_t i = 0; i < scenes.size(); ++i)
      scenes[i].logs[rises.before + k] = static_cast<float>(logs[i]);
  }
  if (is_filled) refine<Lanes, N, kFew>(q, scenes, losses, rises.before, beyond, reduced);
  return true;
}

template <class Lanes, std::size_t N>
VOUSSOIR_INLINE bool look_closer_in(const ReducedQuestion& q, Scenes<Lanes> scenes, std::size_t losses,
                                    Lanes* beyond) {
  ReducedScenes<Lanes> reduced;
  subtract_losses<Lanes>(q, scenes, losses, beyond, reduced);
  if (are_rough(q, reduced, least_of<Lanes>(scenes))) return false;
  refine<Lanes, 0, N>(q, scenes, losses, 0, beyond, reduced);
  return true;
}

template <class Lanes>
VOUSSOIR_INLINE bool look_closer(const ReducedQuestion& q, Scenes<Lanes> scenes, std::size_t losses,
                                 ScreenDirections directions, Lanes* beyond) {
  constexpr auto kMore = static_cast<std::size_t>(ScreenDirections::more);
  if (directions == ScreenDirections::more) return look_closer_in<Lanes, kMore>(q, scenes, losses, beyond);
  return look_closer_in<Lanes, kDirections>(q, scenes, losses, beyond);
}

// What is compiled for every processor cannot be a template.
VOUSSOIR_FOR_EVERY_PROCESSOR
bool look_at(const ReducedQuestion& q, Scenes<FloatLanes> scenes, std::size_t losses, const Rises& rises,
             FloatLanes* beyond) {
  return look<FloatLanes>(q, scenes, losses, rises, beyond);
}
VOUSSOIR_FOR_EVERY_PROCESSOR
bool look_at(const ReducedQuestion& q, Scenes<DoubleLanes> scenes, std::size_t losses, const Rises& rises,
             DoubleLanes* beyond) {
  return look<DoubleLanes>(q, scenes, losses, rises, beyond);
}

VOUSSOIR_FOR_EVERY_PROCESSOR
bool look_closer_at(const ReducedQuestion& q, Scenes<FloatLanes> scenes, std::size_t losses,
                    ScreenDirections directions, FloatLanes* beyond) {
  return look_closer<FloatLanes>(q, scenes, losses, directions, beyond);
}
VOUSSOIR_FOR_EVERY_PROCESSOR
bool look_closer_at(const ReducedQuestion& q, Scenes<DoubleLanes> scenes, std::size_t losses,
                    ScreenDirections directions, DoubleLanes* beyond) {
  return look_closer<DoubleLanes>(q, scenes, losses, directions, beyond);
}

/// Memory of one thread for what is beyond by channel, filled up for all lanes.
template <class Lanes>
Lanes* memory_for(std::size_t channels) {
  thread_local Cells<Lanes> beyond;
  beyond.resize(std::max(beyond.size(), padded(channels, kFloatLanes)));
  return registers_of(beyond);
}

/// Works on all scenes in single precision, or where that is not enough in double, on half of them at a time.
template <class Work>
void in_enough_precision(const ReducedQuestion& question, Scenes<FloatLanes> scenes, Work work) {
  if (work(scenes, memory_for<FloatLanes>(question.points_of_rows))) return;
  DoubleLanes* const memory = memory_for<DoubleLanes>(question.points_of_rows);
  work(scenes.first<kLanes>(), memory);
  work(scenes.last<kLanes>(), memory);
}

}  // namespace

void estimate_log_densities(const ReducedQuestion& question, Scenes<FloatLanes> scenes, std::size_t losses,
                            const Eigen::MatrixXd& rises, std::size_t before) {
  const Rises from{rises.data(), static_cast<std::size_t>(rises.rows()), before};
  in_enough_precision(question, scenes,
                      [&](auto some, auto* memory) { return look_at(question, some, losses, from, memory); });
}

void refine_log_densities(const ReducedQuestion& question, Scenes<FloatLanes> scenes, std::size_t losses,
                          ScreenDirections directions) {
  in_enough_precision(question, scenes, [&](auto some, auto* memory) {
    return look_closer_at(question, some, losses, directions, memory);
  });
}

}  // namespace voussoir
