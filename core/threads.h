#pragma once
/// @file Work side by side on the standard library's threads, for programs that start too quickly to load
/// another library.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace voussoir {

/// How many the machine runs side by side; at least one. The system is asked once: to ask takes
/// microseconds, and a quick search twenty of them.
inline int hardware_threads() {
  static const int threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  return threads;
}

/// Calls the work on this thread and, unless it ends before they begin, on up to so many others at once,
/// which wait for work from then on: to start a thread takes as long as to work out a scene. Returns when
/// nobody is at work any more. The work does not throw; it may itself ask for help.
void run_with_help(int helpers, const std::function<void()>& work);

/// Calls work(0) to work(count - 1) on so many threads, but no more than there is work for, in any order. An
/// exception ends the others' work soon and is thrown on.
template <class Work>
void for_each_index_on_threads(std::size_t count, int threads, const Work& work) {
  std::atomic<std::size_t> next = 0;
  std::exception_ptr failure;
  std::mutex mutex;
  const auto run = [&] {
    try {
      for (std::size_t i = next++; i < count; i = next++) work(i);
    } catch (...) {
      const std::scoped_lock lock(mutex);
      if (!failure) failure = std::current_exception();
      next = count;
    }
  };
  run_with_help(std::min(threads, static_cast<int>(count)) - 1, run);
  if (failure) std::rethrow_exception(failure);
}

}  // namespace voussoir
