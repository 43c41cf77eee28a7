#include "generator/scene_solving.h"

#include "database/format/field_codec.h"

namespace voussoir {

std::vector<Solution> solve_for_storage(const SceneSolver& solver, std::span<const StageTask> scenes) {
  std::vector<Solution> solutions = solver(scenes);
  for (Solution& solution : solutions) {
    solution.displacement = to_storage_precision(solution.displacement);
    solution.memory.clear();  // it is that of the field before rounding
  }
  return solutions;
}

Solution mirrored_solution(const Solution& solution, const MirrorSymmetry& symmetry) {
  Solution image = solution;
  image.displacement = to_storage_precision(mirrored(solution.displacement, symmetry));
  image.memory.clear();
  image.moving = mirrored(solution.moving, symmetry);
  return image;
}

}  // namespace voussoir
