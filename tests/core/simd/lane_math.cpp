#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/random.h"
#include "core/simd/lane_math.h"

using namespace voussoir;

namespace {

double lane_log(double x) {
  DoubleLanes lanes = DoubleLanes{} + x;
  make_logarithm(lanes);
  return lanes[0];
}

double lane_exp(double x) {
  DoubleLanes lanes = DoubleLanes{} + x;
  make_exponential(lanes);
  return lanes[0];
}

double float_log(double x) {
  FloatLanes lanes = FloatLanes{} + static_cast<float>(x);
  make_logarithm(lanes);
  return static_cast<double>(lanes[5]);
}

double float_exp(double x) {
  FloatLanes lanes = FloatLanes{} + static_cast<float>(x);
  make_exponential(lanes);
  return static_cast<double>(lanes[5]);
}

constexpr double kFloatUlp = static_cast<double>(std::numeric_limits<float>::epsilon());
constexpr double kUlp = std::numeric_limits<double>::epsilon();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("The lane logarithm is the library's in extended precision to two units in the last place") {
  Random random(1);
  for (int i = 0; i < 200'000; ++i) {
    const double x = std::exp(1400.0 * (random.uniform() - 0.5)) * (1.0 + random.uniform());
    const auto exact = static_cast<double>(std::log(static_cast<long double>(x)));
    REQUIRE(std::abs(lane_log(x) - exact) <= 2.0 * kUlp * std::max(1.0, std::abs(exact)));
  }
  CHECK(lane_log(1.0) == 0.0);
  CHECK(lane_log(0.0) == -kInfinity);
  CHECK(lane_log(-1.0) == -kInfinity);
  CHECK(lane_log(-0.25) == -kInfinity);
  CHECK(lane_log(kInfinity) == kInfinity);
  CHECK(std::isnan(lane_log(std::nan(""))));
}

TEST_CASE("The lane exponential is the library's in extended precision to three units in the last place") {
  Random random(2);
  for (int i = 0; i < 200'000; ++i) {
    const double x = -707.0 * random.uniform() * random.uniform();
    const auto exact = static_cast<double>(std::exp(static_cast<long double>(x)));
    REQUIRE(std::abs(lane_exp(x) - exact) <= 3.0 * kUlp * exact);
  }
  CHECK(lane_exp(0.0) == 1.0);
  CHECK(lane_exp(-1000.0) == 0.0);
  CHECK(lane_exp(-kInfinity) == 0.0);
  CHECK(std::isnan(lane_exp(std::nan(""))));
}

TEST_CASE("In single precision logarithm and exponential are the library's to two and three units") {
  Random random(3);
  for (int i = 0; i < 200'000; ++i) {
    const auto x = static_cast<double>(static_cast<float>(std::exp(160.0 * (random.uniform() - 0.5))));
    const double log = std::log(x);
    REQUIRE(std::abs(float_log(x) - log) <= 2.0 * kFloatUlp * std::max(1.0, std::abs(log)));
    const auto power = static_cast<double>(static_cast<float>(-86.0 * random.uniform() * random.uniform()));
    REQUIRE(std::abs(float_exp(power) - std::exp(power)) <= 3.0 * kFloatUlp * std::exp(power));
  }
  CHECK(float_log(1.0) == 0.0);
  CHECK(float_exp(0.0) == 1.0);
  CHECK(float_exp(-200.0) == 0.0);
  CHECK(float_exp(-kInfinity) == 0.0);
  CHECK(std::isnan(float_exp(std::nan(""))));
}

TEST_CASE("All four lanes are worked on alike") {
  DoubleLanes x = {1.0, 2.0, 0.25, 1e-9};
  make_logarithm(x);
  for (const int lane : {0, 1, 2, 3})
    CHECK(x[lane] == Approx(std::log(std::array{1.0, 2.0, 0.25, 1e-9}[static_cast<std::size_t>(lane)])));
}
