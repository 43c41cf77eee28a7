#pragma once
/// @file The same bits on all machines.

#include <Eigen/Core>

namespace voussoir {

/// Products of matrices order their sums by the sizes of caches. From now on those of one and the same
/// machine count, so that what a build makes has the same bits everywhere.
inline void fix_order_of_sums() {
  Eigen::setCpuCacheSizes(32 * 1024, 256 * 1024, 2 * 1024 * 1024);
}

}  // namespace voussoir
