#include "generator/scene_solving.h"

#include "database/field_codec.h"

namespace voussoir {

Solution solve_for_storage(const SceneSolver& solver, const Scene& scene, const std::optional<Field>& start) {
  Solution solution = solver(scene, start);
  solution.displacement = to_storage_precision(solution.displacement);
  return solution;
}

Solution mirrored_solution(const Solution& solution, const MirrorSymmetry& symmetry) {
  Solution image = solution;
  image.displacement = to_storage_precision(mirrored(solution.displacement, symmetry));
  return image;
}

}  // namespace voussoir
