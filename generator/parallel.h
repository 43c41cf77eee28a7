#pragma once
/// @file Work side by side on TBB's threads.

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <cstddef>

#ifdef __SANITIZE_THREAD__
#include <sanitizer/tsan_interface.h>
#endif

namespace voussoir {

/// What parallel_for promises, told to ThreadSanitizer, which cannot see it inside the TBB library: all
/// before the call happens before every piece of work, and every piece before the return. Races between
/// pieces still show.
class HandOver {
 public:
#ifdef __SANITIZE_THREAD__
  void give() {
    __tsan_release(&place_);
  }
  void take() {
    __tsan_acquire(&place_);
  }
#else
  void give() {}
  void take() {}
#endif

 private:
  char place_ = 0;
};

/// Calls work(0) to work(count - 1) on the threads of the arena, in any order.
template <class Work>
void for_each_index(oneapi::tbb::task_arena& arena, std::size_t count, const Work& work) {
  HandOver begin;
  HandOver end;
  begin.give();
  arena.execute([&] {
    oneapi::tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
      begin.take();
      work(i);
      end.give();
    });
  });
  end.take();
}

}  // namespace voussoir
