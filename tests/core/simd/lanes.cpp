/// @file Lanes against the same arithmetic on single numbers.

#include "core/simd/lanes.h"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

using namespace voussoir;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

template <class T>
std::array<T, 40> counting() {
  std::array<T, 40> values;
  std::iota(values.begin(), values.end(), T{});
  return values;
}

}  // namespace

TEST_CASE("Lanes are loaded from any address and any type of number, and stored where they are told") {
  const auto doubles = counting<double>();
  const auto shorts = counting<std::int16_t>();
  const auto wide = load<DoubleLanes>(doubles.data() + 3);
  const auto widened = load<DoubleLanes>(shorts.data() + 7);
  for (int i = 0; i < 4; ++i) CHECK(wide[i] == 3.0 + i);
  for (int i = 0; i < 4; ++i) CHECK(widened[i] == 7.0 + i);
  std::array<double, 5> stored{-1.0, -1.0, -1.0, -1.0, -1.0};
  store_some(wide, 3, stored.data() + 1);
  CHECK(stored == std::array{-1.0, 3.0, 4.0, 5.0, -1.0});
}

TEST_CASE("Lanes behind the last value hold the filling") {
  const auto doubles = counting<double>();
  for (std::size_t count = 0; count <= kLanes; ++count) {
    const auto lanes = load_some<DoubleLanes>(doubles.data() + 1, count, -7.0);
    for (std::size_t i = 0; i < kLanes; ++i)
      CHECK(lanes[i] == (i < count ? 1.0 + static_cast<double>(i) : -7.0));
  }
}

TEST_CASE("Sizes have no sign, and sums and the largest are of all lanes") {
  const DoubleLanes lanes{-1.0, 2.0, -0.0, -8.0};
  CHECK(sum_of(magnitude(lanes)) == 11.0);
  CHECK(largest_of(lanes) == 2.0);
  CHECK_FALSE(std::signbit(magnitude(lanes)[2]));
  CHECK(std::isnan(magnitude(DoubleLanes{} + kNan)[1]));
  for (int i = 0; i < 4; ++i) CHECK(square_root(magnitude(lanes))[i] == std::sqrt(std::abs(lanes[i])));
  CHECK(any(lanes < -7.0));
  CHECK_FALSE(any(lanes > 2.0));
  for (int i = 0; i < 8; ++i) {
    FloatLanes one{};
    one[i] = 1.0f;
    CHECK(any(one > 0.5f));
    CHECK_FALSE(any(one > 1.0f));
  }
}
