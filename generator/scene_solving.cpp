#include "generator/scene_solving.h"

#include "database/format/field_codec.h"

namespace voussoir {

std::vector<Solution> solve_for_storage(const SceneSolver& solver, std::span<const StageTask> scenes) {
  std::vector<Solution> solutions = solver(scenes);
  for (std::size_t i = 0; i < solutions.size(); ++i) {
    solutions[i].displacement = to_storage_precision(solutions[i].displacement);
    if (scenes[i].steps == 1) solutions[i].memory.clear();  // it is that of the field before rounding
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
