#include "generator/shown_scenes.h"

#include <algorithm>

#include "core/error.h"
#include "database/records/xdmf.h"
#include "generator/scenes/scene_list.h"

namespace voussoir {

std::vector<Scene> shown_scenes(const std::string& list, const DatabaseToShow& database) {
  if (list.empty()) return {};
  const std::filesystem::path& output = database.output;
  if (index_paths(output).xdmf == output)
    throw InputError(
        fmt::format("--xdmf: {} would be both database and index: expected a database with another ending, "
                    "such as .h5",
                    output.string()));
  if (database.fields == KeepField::no)
    throw InputError("--xdmf shows fields of scenes: expected no --fields none beside it");
  if (const auto other = in_the_way_of_index(output))
    throw InputError(
        fmt::format("--xdmf: {} is there, which the index of {} would replace: expected it to be moved away, "
                    "or another file with -o",
                    other->string(), output.string()));
  std::vector<Scene> scenes = parse_scene_list(list, database.layout);
  for (const Scene& scene : scenes)
    if (!std::ranges::binary_search(database.keys, RecordKey{kNominalVariant, scene}))
      throw InputError(fmt::format("--xdmf: {} would not hold scene {}: expected scenes of --scenes",
                                   output.string(), to_string(scene, database.layout)));
  return scenes;
}

std::string index_removed_in_words(const std::filesystem::path& output) {
  const IndexPaths paths = index_paths(output);
  return fmt::format(
      "{} and {} showed scenes of the file that was replaced and are removed: --xdmf writes them anew",
      paths.xdmf.string(), paths.views.string());
}

}  // namespace voussoir
