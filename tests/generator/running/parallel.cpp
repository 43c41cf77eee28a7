#include "generator/running/parallel.h"

#include <sched.h>

#include <catch2/catch.hpp>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

namespace voussoir {
namespace {

/// The threads that a crew's work is done on.
std::set<std::thread::id> working_threads(Crew& crew) {
  std::set<std::thread::id> threads;
  std::mutex mutex;
  crew.for_each_index(1000, [&](std::size_t) {
    const std::scoped_lock lock(mutex);
    threads.insert(std::this_thread::get_id());
  });
  return threads;
}

}  // namespace

TEST_CASE("A crew of one works on one thread, also on a machine with more cores") {
  Crew crew(1);
  CHECK(crew.size() == 1);
  CHECK(working_threads(crew).size() == 1);
}

TEST_CASE("A crew of no stated size has a thread for each core (as the system says the process may use)") {
  cpu_set_t cores;
  REQUIRE(sched_getaffinity(0, sizeof cores, &cores) == 0);
  Crew crew(0);
  CHECK(crew.size() == CPU_COUNT(&cores));
  CHECK(working_threads(crew).size() <= static_cast<std::size_t>(CPU_COUNT(&cores)));
}

TEST_CASE("A crew of a stated size has it and does every piece of work once (counted)", "[threads]") {
  for (const int threads : {1, 2, 3}) {
    Crew crew(threads);
    CHECK(crew.size() == threads);
    std::vector<int> done(1000, 0);
    crew.for_each_index(done.size(), [&](std::size_t i) { ++done[i]; });
    CHECK(done == std::vector<int>(done.size(), 1));
  }
}

}  // namespace voussoir
