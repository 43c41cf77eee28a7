#pragma once
/// @file Work side by side on several threads.

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <cstddef>

#include "core/threads.h"

namespace voussoir {

/// A number of threads to work on; as many as they may be while the crew lives.
class Crew {
 public:
  /// 0: one for each core.
  explicit Crew(int threads)
      : arena_(threads > 0 ? threads : oneapi::tbb::info::default_concurrency()),
        allowed_(oneapi::tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(size())) {}

  int size() const { return arena_.max_concurrency(); }

  /// Calls work(0) to work(count - 1), in any order. An exception ends the others' work soon and is thrown
  /// on.
  template <class Work>
  void for_each_index(std::size_t count, const Work& work);

 private:
  oneapi::tbb::task_arena arena_;
  oneapi::tbb::global_control allowed_;
};

#ifdef __SANITIZE_THREAD__

/// On plain threads: ThreadSanitizer does not see how the TBB library, which was not compiled with
/// it, hands work from thread to thread, and takes that for races. What the pieces of work do to each other
/// still shows.
template <class Work>
void Crew::for_each_index(std::size_t count, const Work& work) {
  for_each_index_on_threads(count, size(), work);
}

#else

template <class Work>
void Crew::for_each_index(std::size_t count, const Work& work) {
  // Piece by piece, as work is dear and uneven.
  arena_.execute(
      [&] { oneapi::tbb::parallel_for(std::size_t{0}, count, work, oneapi::tbb::simple_partitioner()); });
}

#endif

}  // namespace voussoir
