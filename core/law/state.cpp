#include "core/law/state.h"

namespace voussoir {

std::vector<JointMemory> memory_of_slip(const Eigen::Matrix2Xd& slip) {
  std::vector<JointMemory> memory;
  for (Eigen::Index joint = 0; joint < slip.cols(); ++joint)
    memory.push_back({.slip_0 = slip(0, joint), .slip_1 = slip(1, joint)});
  return memory;
}

Eigen::Matrix2Xd slip_of(const std::vector<JointMemory>& memory) {
  Eigen::Matrix2Xd slip(2, static_cast<Eigen::Index>(memory.size()));
  for (std::size_t joint = 0; joint < memory.size(); ++joint)
    slip.col(static_cast<Eigen::Index>(joint)) << memory[joint].slip_0, memory[joint].slip_1;
  return slip;
}

}  // namespace voussoir
