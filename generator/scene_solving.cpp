#include "generator/scene_solving.h"

#include "database/field_codec.h"

namespace voussoir {

std::vector<Solution> solve_for_storage(const SceneSolver& solver, std::span<const Scene> scenes,
                                        const StartingFields& starts) {
  std::vector<std::optional<Field>> fields;
  for (const Scene& scene : scenes) fields.push_back(starts.start_for(scene));
  std::vector<SceneStart> tasks;
  for (std::size_t i = 0; i < scenes.size(); ++i)
    tasks.push_back({scenes[i], fields[i] ? &*fields[i] : nullptr});
  std::vector<Solution> solutions = solver(tasks);
  for (Solution& solution : solutions) solution.displacement = to_storage_precision(solution.displacement);
  return solutions;
}

Solution mirrored_solution(const Solution& solution, const MirrorSymmetry& symmetry) {
  Solution image = solution;
  image.displacement = to_storage_precision(mirrored(solution.displacement, symmetry));
  return image;
}

}  // namespace voussoir
