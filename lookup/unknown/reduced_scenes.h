#pragma once
/// @file Scenes in the directions of a screen, side by side in lanes: what no case changes of their
/// Gaussians.

#include <span>
#include <type_traits>

#include "core/simd/lanes.h"
#include "lookup/unknown/reduced_density.h"

namespace voussoir {

inline constexpr auto kFirstWidth = static_cast<std::size_t>(kFirstColumns);

/// As many scenes as there are lanes.
template <class Lanes>
inline constexpr std::size_t kScenes = sizeof(Lanes) / sizeof(ElementOf<Lanes>);
template <class Lanes>
using Scenes = std::span<const ScenePrediction, kScenes<Lanes>>;

/// Numbers of the scenes, one after the other, as lanes.
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
VOUSSOIR_INLINE void transpose(FloatLanes (&rows)[kFloatLanes]) {
  FloatLanes pairs[kFloatLanes], fours[kFloatLanes];
  for (std::size_t i = 0; i < kFloatLanes; i += 2) {
    pairs[i] = __builtin_shufflevector(rows[i], rows[i + 1], 0, 8, 1, 9, 4, 12, 5, 13);
    pairs[i + 1] = __builtin_shufflevector(rows[i], rows[i + 1], 2, 10, 3, 11, 6, 14, 7, 15);
  }
  for (std::size_t i = 0; i < kFloatLanes; i += 4)
    for (std::size_t k = 0; k < 2; ++k) {
      const FloatLanes &one = pairs[i + k], &two = pairs[i + 2 + k];
      fours[i + 2 * k] = __builtin_shufflevector(one, two, 0, 1, 8, 9, 4, 5, 12, 13);
      fours[i + 2 * k + 1] = __builtin_shufflevector(one, two, 2, 3, 10, 11, 6, 7, 14, 15);
    }
  for (std::size_t k = 0; k < 4; ++k) {
    rows[k] = __builtin_shufflevector(fours[k], fours[4 + k], 0, 1, 2, 3, 8, 9, 10, 11);
    rows[4 + k] = __builtin_shufflevector(fours[k], fours[4 + k], 4, 5, 6, 7, 12, 13, 14, 15);
  }
}

/// What no case changes of the scenes' Gaussians, in some of the directions.
template <class Lanes>
struct ReducedScenes {
  Lanes signal[kDirections];
  Lanes beyond[kDirections];  // of it what is not that of its losses
  Lanes mean_square;          // of that over the channels read; NaN: the scene is impossible
  Lanes bridge[lower_size(kDirections)], epoch[lower_size(kDirections)], model_error[lower_size(kDirections)];
  Lanes loose[lower_size(kDirections)];  // what a spread of 1 of the signal beyond its losses adds
};

/// Some numbers of each scene's losses, summed up over them.
template <class Lanes, std::size_t kCount, class Numbers>
VOUSSOIR_INLINE void add_up(Scenes<Lanes> scenes, std::size_t count, Numbers numbers, Lanes* sums) {
  constexpr std::size_t kTogether = kScenes<Lanes>;
  for (std::size_t at = 0; at < count; at += kTogether) {
    Lanes rows[kTogether];
    for (std::size_t k = 0; k < kTogether; ++k) {
      const auto of = [&](std::size_t l) VOUSSOIR_INLINE_WORK {
        return load<Lanes>(numbers(scenes[k].losses[l]->template in<ElementOf<Lanes>>()) + at);
      };
      rows[k] = of(0);
      for (std::size_t l = 1; l < kCount; ++l) rows[k] += of(l);
    }
    transpose(rows);
    for (std::size_t k = 0; k < kTogether; ++k) sums[at + k] = rows[k];
  }
}

/// What scenes show by channel, and what that of their losses is subtracted from it.
template <std::size_t kTogether, std::size_t kCount>
struct ShownByChannel {
  const double* rows[kTogether];
  const double* of_losses[kTogether][kCount];  // the first with that of the intact bridge
};
template <class Lanes, std::size_t kCount>
VOUSSOIR_INLINE ShownByChannel<kScenes<Lanes>, kCount> shown_by_channel(Scenes<Lanes> scenes) {
  ShownByChannel<kScenes<Lanes>, kCount> result;
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    result.rows[k] = scenes[k].prediction;
    result.of_losses[k][0] = scenes[k].losses[0]->shown.data();
    for (std::size_t l = 1; l < kCount; ++l) result.of_losses[k][l] = scenes[k].losses[l]->signal.data();
  }
  return result;
}

/// What is beyond the losses' signals at as many channels as there are lanes, of which rows have `count`:
/// differences of large numbers, so in double precision.
template <class Lanes, std::size_t kTogether, std::size_t kCount>
VOUSSOIR_INLINE void subtract_losses_at(const ShownByChannel<kTogether, kCount>& shown, const double* is_read,
                                        std::size_t at, std::size_t count, Lanes (&rows)[kTogether]) {
  constexpr std::size_t kParts = kTogether / kLanes;
  DoubleLanes read[kParts];
  for (std::size_t part = 0; part < kParts; ++part)
    read[part] = load<DoubleLanes>(is_read + at + part * kLanes);
#pragma GCC unroll 8
  for (std::size_t k = 0; k < kTogether; ++k) {
    DoubleLanes beyond[kParts];
    for (std::size_t part = 0; part < kParts; ++part) {
      const std::size_t from = at + part * kLanes, before = part * kLanes;
      beyond[part] = load_some<DoubleLanes>(shown.rows[k] + from,
                                            count < before ? 0 : smaller(count - before, kLanes), 0.0);
      for (std::size_t l = 0; l < kCount; ++l)
        beyond[part] -= load<DoubleLanes>(shown.of_losses[k][l] + from);
      beyond[part] = read[part] > 0.0 ? beyond[part] : DoubleLanes{};
    }
    if constexpr (kParts == 1) {
      rows[k] = beyond[0];
    } else {
      using HalfLanes = LanesOf<float, kLanes>::Type;
      rows[k] =
          __builtin_shufflevector(__builtin_convertvector(beyond[0], HalfLanes),
                                  __builtin_convertvector(beyond[1], HalfLanes), 0, 1, 2, 3, 4, 5, 6, 7);
    }
  }
}

/// What is beyond the losses' signals by channel, and the mean square of it.
template <class Lanes, std::size_t kCount>
VOUSSOIR_INLINE void subtract_losses(const ReducedQuestion& q, Scenes<Lanes> scenes, Lanes* beyond,
                                     ReducedScenes<Lanes>& to) {
  constexpr std::size_t kTogether = kScenes<Lanes>;
  const auto shown = shown_by_channel<Lanes, kCount>(scenes);
  Lanes squares{};
  const auto some = [&](std::size_t at, std::size_t count) VOUSSOIR_INLINE_WORK {
    Lanes rows[kTogether];
    subtract_losses_at(shown, q.is_read, at, count, rows);
    transpose(rows);
    for (std::size_t k = 0; k < kTogether; ++k) {
      beyond[at + k] = rows[k];
      squares += rows[k] * rows[k];
    }
  };
  const std::size_t whole = q.points_of_rows / kTogether * kTogether;
  for (std::size_t at = 0; at < whole; at += kTogether) some(at, kTogether);
  if (whole < q.points_of_rows) some(whole, q.points_of_rows - whole);
  to.mean_square = squares / static_cast<ElementOf<Lanes>>(q.read);
}

/// What is beyond, in the directions from kFirst to N, some at a time, whose sums stay in registers.
template <class Lanes, std::size_t kFirst, std::size_t N>
VOUSSOIR_INLINE void project(const ReducedQuestion& q, const Lanes* beyond, ReducedScenes<Lanes>& to) {
  constexpr std::size_t kTogether = N - kFirst < 8 ? N - kFirst : 8;
  const ElementOf<Lanes>* directions;
  if constexpr (std::is_same_v<ElementOf<Lanes>, float>)
    directions = q.rounded_directions;
  else
    directions = q.directions;
  for (std::size_t first = kFirst; first < N; first += kTogether) {
    Lanes sums[kTogether] = {};
    for (std::size_t k = 0; k < q.points_of_rows; ++k)
      for (std::size_t i = 0; i < kTogether; ++i)
        sums[i] += beyond[k] * directions[k * kDirections + first + i];
    for (std::size_t i = 0; i < kTogether; ++i) to.beyond[first + i] = sums[i];
  }
}

template <class Lanes, std::size_t kColumns>
VOUSSOIR_INLINE void add_products(const Lanes* columns, std::size_t rows, Lanes* lower) {
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j <= i; ++j, ++lower)
      for (std::size_t p = 0; p < kColumns; ++p)
        *lower += columns[i * kColumns + p] * columns[j * kColumns + p];
}

/// What the losses add to a covariance in the first N directions: each by itself, and by the columns in
/// common.
template <class Lanes, std::size_t N, std::size_t kCount, std::size_t kColumns, class Part, class Columns>
VOUSSOIR_INLINE void add_losses(Scenes<Lanes> scenes, Part part, Columns numbers, Lanes* lower) {
  static_assert(N * kColumns % kScenes<Lanes> == 0);
  Lanes columns[N * kColumns];
  add_up<Lanes, kCount>(
      scenes, lower_size(N),
      [part](const auto& loss) VOUSSOIR_INLINE_WORK { return part(loss)[kCount - 1].data(); }, lower);
  add_up<Lanes, kCount>(scenes, N * kColumns, numbers, columns);
  add_products<Lanes, kColumns>(columns, N, lower);
}

/// The signals and triangles of the first N directions, in which it is known what is beyond.
template <class Lanes, std::size_t N, std::size_t kCount>
VOUSSOIR_INLINE void fill(const ReducedQuestion& q, Scenes<Lanes> scenes, ReducedScenes<Lanes>& to) {
  using Number = ElementOf<Lanes>;
  constexpr std::size_t kSize = lower_size(N);
  add_up<Lanes, kCount>(
      scenes, N, [](const auto& loss) VOUSSOIR_INLINE_WORK { return loss.signal.data(); }, to.signal);
  for (std::size_t i = 0; i < N; ++i) to.signal[i] += to.beyond[i];
  add_losses<Lanes, N, kCount, kFirstWidth>(
      scenes, [](const auto& loss) VOUSSOIR_INLINE_WORK -> const auto& { return loss.of_bridge; },
      [](const auto& loss) VOUSSOIR_INLINE_WORK { return loss.first.data(); }, to.bridge);
  for (std::size_t at = 0; at < kSize; ++at) to.bridge[at] += static_cast<Number>(q.bridge[at]);
  add_losses<Lanes, N, kCount, kEpochColumns>(
      scenes, [](const auto& loss) VOUSSOIR_INLINE_WORK -> const auto& { return loss.of_epoch; },
      [](const auto& loss) VOUSSOIR_INLINE_WORK { return loss.epoch.data(); }, to.epoch);
  add_up<Lanes, kCount>(
      scenes, kSize, [](const auto& loss) VOUSSOIR_INLINE_WORK { return loss.model_error.data(); },
      to.model_error);
  Lanes at_points{};
  for (std::size_t k = 0; k < scenes.size(); ++k) at_points[k] = static_cast<Number>(scenes[k].at_points);
  const Lanes square_at_points = at_points * to.mean_square;
  std::size_t at = 0;
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = 0; j <= i; ++j, ++at)
      to.loose[at] = to.beyond[i] * to.beyond[j] + square_at_points * static_cast<Number>(q.points[at]);
}

}  // namespace voussoir
