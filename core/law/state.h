#pragma once
/// @file What a stage leaves behind, and the next one starts from.

#include <vector>

#include "core/structure/mesh.h"

namespace voussoir {

/// Plastic slip of a joint at the two ends of its stretch [m]: what friction has given way by. Linear in
/// between.
struct JointMemory {
  double slip_0 = 0.0;
  double slip_1 = 0.0;
  friend bool operator==(const JointMemory&, const JointMemory&) = default;
};

struct State {
  Field displacement;               ///< [m], 2 x nodes; NaN at nodes of removed blocks
  std::vector<JointMemory> memory;  ///< of each joint; empty: nothing has slipped
};

}  // namespace voussoir
