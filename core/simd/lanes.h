#pragma once
/// @file Numbers side by side in one register, one for each scene of a group or each reading of a row: the
/// types, how they are compiled for every processor, and arithmetic that is the same for all of them.
///
/// Kernels are templates on a number, which is a double or DoubleLanes, or loops over DoubleLanes or
/// FloatLanes. Conditions
/// are masks (bool, or one whole number for each lane), `mask ? a : b` picks lane by lane, and no operation
/// mixes lanes unless it says so: a lane's bits do not depend on what the others hold.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

/// What is compiled for every processor must be inlined there, or it is compiled for the oldest only.
#define VOUSSOIR_INLINE inline __attribute__((always_inline))

/// Compiles a function twice, for processors with and without AVX2 and fused operations, and picks at
/// start-up. Without contraction to fused operations (the project is compiled so, but for estimates of
/// scenes: CMakeLists.txt) both give the same bits. Not under sanitizers, whose run-time is not ready when
/// the choice is made.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__x86_64__)
#define VOUSSOIR_FOR_EVERY_PROCESSOR
#else
#define VOUSSOIR_FOR_EVERY_PROCESSOR __attribute__((target_clones("arch=x86-64-v3", "default")))
#endif

namespace voussoir {

template <class Element, std::size_t count>
struct LanesOf {
  using Type [[gnu::vector_size(count * sizeof(Element))]] = Element;
};

/// Doubles, or scenes, side by side: four doubles are one AVX register.
inline constexpr std::size_t kLanes = 4;
using DoubleLanes = LanesOf<double, kLanes>::Type;
using DoubleMask = LanesOf<std::int64_t, kLanes>::Type;

inline constexpr std::size_t kFloatLanes = 8;
using FloatLanes = LanesOf<float, kFloatLanes>::Type;
using FloatMask = LanesOf<std::int32_t, kFloatLanes>::Type;

/// How many numbers there are with those that fill them up to a whole number of lanes.
constexpr std::size_t padded(std::size_t count, std::size_t lanes = kLanes) {
  return (count + lanes - 1) / lanes * lanes;
}

template <class Lanes>
using ElementOf = std::remove_cvref_t<decltype(Lanes{}[0])>;

/// How many scenes a number is for: 1 for a double.
template <class T>
inline constexpr int kLaneCount = static_cast<int>(sizeof(T) / sizeof(double));

template <class T>
VOUSSOIR_INLINE double lane(const T& number, [[maybe_unused]] int i) {
  if constexpr (kLaneCount<T> == 1)
    return number;
  else
    return number[i];
}

template <class T>
VOUSSOIR_INLINE void set_lane(T& number, [[maybe_unused]] int i, double value) {
  if constexpr (kLaneCount<T> == 1)
    number = value;
  else
    number[i] = value;
}

/// As many values as there are lanes, from any address, converted if they are of another type.
template <class Lanes, class From>
VOUSSOIR_INLINE Lanes load(const From* from) {
  typename LanesOf<From, sizeof(Lanes) / sizeof(ElementOf<Lanes>)>::Type values;
  std::memcpy(&values, from, sizeof values);
  return __builtin_convertvector(values, Lanes);
}

/// The first `count` (at most all) lanes; `filling` behind them.
template <class Lanes>
VOUSSOIR_INLINE Lanes load_some(const ElementOf<Lanes>* from, std::size_t count, ElementOf<Lanes> filling) {
  if (count * sizeof *from == sizeof(Lanes)) return load<Lanes>(from);
  Lanes lanes = Lanes{} + filling;
  for (std::size_t i = 0; i < count; ++i) lanes[i] = from[i];
  return lanes;
}
template <class Lanes>
VOUSSOIR_INLINE void store_some(const Lanes& lanes, std::size_t count, ElementOf<Lanes>* to) {
  std::memcpy(to, &lanes, count * sizeof *to == sizeof lanes ? sizeof lanes : count * sizeof *to);
}

/// Calls work(i, kLanes) for every kLanes of `size` numbers and work(i, rest) for the last few. Where it is
/// inlined (VOUSSOIR_INLINE_WORK), whole registers are loaded without a look at how many numbers there are.
#define VOUSSOIR_INLINE_WORK __attribute__((always_inline))
template <class Work>
VOUSSOIR_INLINE void for_lanes(std::size_t size, Work work) {
  std::size_t i = 0;
  for (; i + kLanes <= size; i += kLanes) work(i, kLanes);
  if (i < size) work(i, size - i);
}

template <class T>
VOUSSOIR_INLINE T larger(T a, T b) {
  return a > b ? a : b;
}

template <class T>
VOUSSOIR_INLINE T smaller(T a, T b) {
  return a < b ? a : b;
}

/// |a|
VOUSSOIR_INLINE double magnitude(double a) {
  return __builtin_fabs(a);
}
VOUSSOIR_INLINE DoubleLanes magnitude(DoubleLanes a) {
  return reinterpret_cast<DoubleLanes>(reinterpret_cast<DoubleMask>(a) & INT64_MAX);
}

VOUSSOIR_INLINE double square_root(double a) {
  return __builtin_sqrt(a);
}
#ifdef __SSE2__
/// Two roots at a time, which every processor with 64 bits has and the compiler does not find.
VOUSSOIR_INLINE DoubleLanes square_root(DoubleLanes a) {
  const __m128d low = _mm_sqrt_pd(__builtin_shufflevector(a, a, 0, 1));
  const __m128d high = _mm_sqrt_pd(__builtin_shufflevector(a, a, 2, 3));
  return __builtin_shufflevector(low, high, 0, 1, 2, 3);
}
#else
VOUSSOIR_INLINE DoubleLanes square_root(DoubleLanes a) {
  for (std::size_t i = 0; i < kLanes; ++i) a[i] = __builtin_sqrt(a[i]);
  return a;
}
#endif

/// 1 / sqrt(a) to round-off for a in [3, 4.2]; a is taken to the nearer end outside. Without roots and
/// quotients, which take longest of all.
template <class T>
VOUSSOIR_INLINE T inverse_root_near_four(T a) {
  const T bounded = smaller(larger(a, T{} + 3.0), T{} + 4.2);
  T root = 0.7999 - 0.0745 * bounded;  // within 0.2 %
  for (int i = 0; i < 3; ++i) root = root * (1.5 - 0.5 * bounded * root * root);
  return root;
}

/// True if the condition holds in some lane.
template <class Mask>
VOUSSOIR_INLINE bool any(const Mask& mask) {
  if constexpr (sizeof(Mask) <= sizeof(int)) {
    return static_cast<bool>(mask);
  } else {
    constexpr std::size_t kWords = sizeof(Mask) / sizeof(std::int64_t);
    const auto words = reinterpret_cast<typename LanesOf<std::int64_t, kWords>::Type>(mask);
    std::int64_t either = 0;
    for (std::size_t i = 0; i < kWords; ++i) either |= words[i];
    return either != 0;
  }
}

/// Sum and largest of all lanes, always in one order.
VOUSSOIR_INLINE double sum_of(const DoubleLanes& lanes) {
  return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]);
}
VOUSSOIR_INLINE float sum_of(const FloatLanes& lanes) {
  using HalfLanes = LanesOf<float, kFloatLanes / 2>::Type;
  HalfLanes low, high;
  std::memcpy(&low, &lanes, sizeof low);
  std::memcpy(&high, reinterpret_cast<const char*>(&lanes) + sizeof low, sizeof high);
  low += high;
  return (low[0] + low[2]) + (low[1] + low[3]);
}
VOUSSOIR_INLINE double largest_of(const DoubleLanes& lanes) {
  return larger(larger(lanes[0], lanes[1]), larger(lanes[2], lanes[3]));
}

/// A number by itself in memory. Aligned for the widest instruction set that any clone of a kernel may use,
/// which the compiler does not do when it compiles for the oldest.
template <class T>
struct alignas(sizeof(T)) Cell {
  T value;
};

template <class T>
using Cells = std::vector<Cell<T>>;

/// Values of several scenes: entry i of scene l is `[i].value[l]`.
using LaneVector = Cells<DoubleLanes>;

template <class T>
T* registers_of(std::vector<Cell<T>>& values) {
  return reinterpret_cast<T*>(values.data());
}
template <class T>
const T* registers_of(const std::vector<Cell<T>>& values) {
  return reinterpret_cast<const T*>(values.data());
}

}  // namespace voussoir
