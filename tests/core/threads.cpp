/// @file Work on several threads. Oracle: each number once, and threads that wait for each other.

#include "core/threads.h"

#include <catch2/catch.hpp>
#include <chrono>
#include <condition_variable>
#include <stdexcept>
#include <vector>

namespace voussoir {
namespace {

std::vector<int> calls(std::size_t count, int threads) {
  std::vector<int> called(count, 0);
  for_each_index_on_threads(count, threads, [&](std::size_t i) { ++called[i]; });
  return called;
}

/// Whether so many pieces of work are under way at once: each waits for all others, for ten seconds at most.
bool all_at_once(int pieces) {
  std::mutex mutex;
  std::condition_variable changed;
  int arrived = 0;
  bool together = true;
  for_each_index_on_threads(static_cast<std::size_t>(pieces), pieces, [&](std::size_t) {
    std::unique_lock lock(mutex);
    if (++arrived == pieces) changed.notify_all();
    together &= changed.wait_for(lock, std::chrono::seconds(10), [&] { return arrived == pieces; });
  });
  return together;
}

}  // namespace

TEST_CASE("Every index is worked on once, on any number of threads, again and again", "[threads]") {
  for (const int threads : {1, 2, 3, 8})
    for (const std::size_t count : {0, 1, 2, 7, 1000})
      for (int again = 0; again < 20; ++again) REQUIRE(calls(count, threads) == std::vector<int>(count, 1));
}

TEST_CASE("As many threads as were asked for work at once", "[threads]") {
  for (const int threads : {2, 5, 3}) CHECK(all_at_once(threads));
}

TEST_CASE("Work asks for help itself, and several ask at once", "[threads]") {
  std::vector<std::vector<int>> called(16);
  const auto nested = [&](std::size_t first) {
    for_each_index_on_threads(4, 3, [&](std::size_t i) { called[first + i] = calls(50, 3); });
  };
  std::vector<std::jthread> others;
  for (const std::size_t first : {0, 4, 8, 12}) others.emplace_back(nested, first);
  others.clear();
  for (const std::vector<int>& one : called) CHECK(one == std::vector<int>(50, 1));
}

TEST_CASE("An exception ends the work and is thrown on, and the threads go on working", "[threads]") {
  std::atomic<int> worked = 0;
  const auto fails = [&](std::size_t i) {
    if (i == 10) throw std::runtime_error("ten");
    ++worked;
  };
  CHECK_THROWS_WITH(for_each_index_on_threads(1000000, 4, fails), "ten");
  CHECK(worked < 1000000);
  CHECK(calls(100, 4) == std::vector<int>(100, 1));
}

}  // namespace voussoir
