#include "core/motion_step.h"

#include "core/motion_kernels.h"

// The same code for the newest common instruction set and for the oldest; without contraction both give the same bits.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define VOUSSOIR_VECTORISED __attribute__((target_clones("avx2", "default")))
#else
#define VOUSSOIR_VECTORISED
#endif

namespace voussoir {

void take_implicit_step(const MotionModel& model, Motion<Lanes<1>>& motion) {
  implicit_step(model, motion);
}

VOUSSOIR_VECTORISED void take_implicit_step(const MotionModel& model, Motion<Lanes<4>>& motion) {
  implicit_step(model, motion);
}

}  // namespace voussoir
