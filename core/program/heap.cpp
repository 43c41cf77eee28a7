#include "core/program/heap.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace voussoir {
namespace {

void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int kNever = 1 << 30;
  mallopt(M_MMAP_THRESHOLD, kNever);
  mallopt(M_TRIM_THRESHOLD, kNever);
  mallopt(M_TOP_PAD, 1 << 20);
#endif
}

void take_large_pages() {
#if defined(__GLIBC__) && defined(MADV_HUGEPAGE)
  constexpr std::size_t kRoom = 64 << 20;
  constexpr std::uintptr_t kLargePage = 2 << 20, kSmallPage = 4 << 10;
  const auto so_far = reinterpret_cast<std::uintptr_t>(::sbrk(0));
  const std::uintptr_t to_large = kLargePage - (so_far + kSmallPage) % kLargePage;
  static_cast<void>(::sbrk(static_cast<std::intptr_t>(to_large)));
  char* const room = static_cast<char*>(std::malloc(kRoom));
  if (room != nullptr) {
    // What malloc notes before the room is in a small page, and would make small ones of the first large
    // page.
    char* const large = room + (kLargePage - reinterpret_cast<std::uintptr_t>(room) % kLargePage);
    static_cast<void>(::madvise(large, kRoom - kLargePage, MADV_HUGEPAGE));
  }
  std::free(room);
#endif
}

}  // namespace

void prepare_heap() {
  keep_freed_memory();
  take_large_pages();
}

void share_heap() {
#ifdef __GLIBC__
  mallopt(M_ARENA_MAX, 1);
#endif
}

}  // namespace voussoir
