#include "generator/scenes/scene_solving.h"

#include "database/format/field_codec.h"

namespace voussoir {

std::vector<Solution> solve_for_storage(const StageSolver& solver, std::span<const StageTask> scenes) {
  std::vector<Solution> solutions = solver(scenes);
  for (std::size_t i = 0; i < solutions.size(); ++i) {
    solutions[i].displacement = to_storage_precision(solutions[i].displacement);
    solutions[i].slipped =
        stands(solutions[i]) ? to_storage_precision(solutions[i].slipped) : Eigen::Matrix2Xd();
    const bool follows = scenes[i].steps == 1 || has_slipped(solutions[i]);
    if (follows) solutions[i].memory.clear();  // it is that of the field before rounding
  }
  return solutions;
}

Solution mirrored_solution(const Solution& solution, const Structure& bridge) {
  const MirrorSymmetry& symmetry = *bridge.symmetry;
  Solution image = solution;
  image.displacement = to_storage_precision(mirrored(solution.displacement, symmetry));
  image.slipped = to_storage_precision(mirrored_slip(solution.slipped, bridge.joints, symmetry));
  image.memory.clear();
  image.moving = mirrored(solution.moving, symmetry);
  return image;
}

}  // namespace voussoir
