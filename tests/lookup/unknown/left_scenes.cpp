/// @file Oracle: a stable sort, and sums of what is left, each added up anew.

#include "lookup/unknown/left_scenes.h"

#include <catch2/catch.hpp>
#include <numeric>

#include "core/random.h"

namespace voussoir {
namespace {

std::vector<std::size_t> all_places(std::size_t count) {
  std::vector<std::size_t> places(count);
  std::iota(places.begin(), places.end(), std::size_t{0});
  return places;
}

/// Logarithms over so wide a range that the first hide the last in a sum; every seventh is there twice.
std::vector<double> estimates_over(double range, std::size_t count) {
  Random random(2);
  std::vector<double> estimates;
  while (estimates.size() < count) {
    estimates.push_back(range * (random.uniform() - 0.5));
    if (estimates.size() % 7 == 0) estimates.push_back(estimates.back());
  }
  return estimates;
}

double log_sum_of(std::span<const std::size_t> places, const std::vector<double>& logs) {
  long double sum = 0.0L;
  for (const std::size_t place : places) sum += std::exp(static_cast<long double>(logs[place]));
  return static_cast<double>(std::log(sum));
}

}  // namespace

TEST_CASE("Places come in the order of a stable sort") {
  const std::vector<double> values = estimates_over(10.0, 100);
  std::vector<std::size_t> sorted = all_places(values.size());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](std::size_t a, std::size_t b) { return values[a] > values[b]; });
  DescendingPlaces places(all_places(values.size()), values);
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    REQUIRE(places.rest().size() == sorted.size() - i);
    REQUIRE(places.first() == sorted[i]);
    REQUIRE(places.next() == sorted[i]);
  }
  CHECK(places.empty());
}

TEST_CASE("What is left sums up right however much was taken away") {
  const double range = GENERATE(1.0, 30.0, 200.0);
  const std::vector<double> estimates = estimates_over(range, 400);
  LeftScenes left(all_places(estimates.size()), estimates,
                  [](std::size_t place) { return place % LeftScenes::kKinds; });
  while (!left.empty()) {
    REQUIRE(left.log_sum() == Approx(log_sum_of(left.places(), estimates)).margin(1e-8));
    const std::vector<std::size_t> taken = left.next(8);
    for (const std::size_t place : taken)
      for (const std::size_t other : left.places()) REQUIRE(estimates[place] >= estimates[other]);
  }
}

TEST_CASE("Scenes count for what those of their kind have shown, but others for what they are estimated at") {
  const std::vector<double> estimates(200, 1.5);
  LeftScenes left(all_places(estimates.size()), estimates,
                  [](std::size_t place) { return place % 2 == 0 ? std::size_t{2} : LeftScenes::kOther; });
  const double all = left.log_sum();
  for (std::size_t learned = 0; learned < 64;) {
    for (const std::size_t place : left.next(2)) left.learn(place, estimates[place] - 4.0);
    if (++learned == 15) CHECK(left.log_sum() == Approx(std::log(std::exp(1.5) * 170.0)));
  }
  // Half of 64 were too high by 4, so at most three in 32 are not.
  const double known = std::exp(1.5) * 36.0 * (std::exp(-4.0) + 3.0 / 32.0), others = std::exp(1.5) * 36.0;
  CHECK(all == Approx(std::log(std::exp(1.5) * 200.0)));
  CHECK(left.log_sum() == Approx(std::log(known + others)));
  const std::vector<PlaceLog> corrected = left.corrected();
  CHECK(corrected.size() == left.places().size());
  for (const auto& [place, log] : corrected) {
    CHECK(place >= 128);
    CHECK(log == Approx(1.5 - 4.0));
  }
}

TEST_CASE("Estimates that changed are put in order again and added up anew") {
  std::vector<double> estimates = estimates_over(30.0, 400);
  LeftScenes left(all_places(estimates.size()), estimates, [](std::size_t) { return std::size_t{1}; });
  left.next(100);
  for (std::size_t place = 0; place < estimates.size(); place += 3) estimates[place] -= 20.0;
  left.order_again();
  REQUIRE(left.places().size() == 300);
  REQUIRE(left.log_sum() == Approx(log_sum_of(left.places(), estimates)).margin(1e-8));
  double last = estimates[left.next(1).front()];
  while (!left.empty()) {
    const double next = estimates[left.next(1).front()];
    REQUIRE(next <= last);
    last = next;
  }
}

TEST_CASE("Estimates that were right, or too low, lower nothing") {
  EstimateErrors errors;
  CHECK(errors.most() == 0.0);
  CHECK(errors.mean() == 0.0);
  for (int i = 0; i < 40; ++i) errors.add(1.0, 1.0 + 0.1 * (i % 3));
  CHECK(errors.most() == 0.0);
  CHECK(errors.mean() == 0.0);
}

}  // namespace voussoir
