#include "core/law/state.h"

namespace voussoir {

std::vector<JointMemory> memory_of_slip(const Eigen::Matrix2Xd& slip) {
  std::vector<JointMemory> memory;
  for (Eigen::Index joint = 0; joint < slip.cols(); ++joint)
    memory.push_back({.slip_0 = slip(0, joint), .slip_1 = slip(1, joint)});
  return memory;
}

}  // namespace voussoir
