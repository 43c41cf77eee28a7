#include "core/heap.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace voussoir {

void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int kNever = 1 << 30;
  mallopt(M_MMAP_THRESHOLD, kNever);
  mallopt(M_TRIM_THRESHOLD, kNever);
  mallopt(M_TOP_PAD, 1 << 20);
#endif
}

}  // namespace voussoir
