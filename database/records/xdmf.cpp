#include "database/records/xdmf.h"

#include <fstream>

#include "core/error.h"
#include "core/text.h"
#include "database/format/hdf5_writing.h"
#include "database/records/schema.h"

namespace voussoir {
namespace {

struct IndexedScene {
  std::string name;
  std::size_t row = 0;

  /// The name of its dataset: labels may hold what is a path there.
  std::string view() const { return fmt::format("{}", row); }
};

std::vector<IndexedScene> find_scenes(const Database& database, const std::vector<Scene>& scenes) {
  std::vector<IndexedScene> found;
  for (const Scene& scene : scenes) {
    const std::string name = to_string(scene, database.layout());
    const auto row = database.find(scene);
    if (!row) throw InputError(fmt::format("{}: does not hold scene {}", database.path().string(), name));
    found.push_back({name, *row});
  }
  return found;
}

/// As it stands in the index.
std::string name_of_views(const std::filesystem::path& database) {
  return escaped(index_paths(database).views.filename().string());
}

std::string data_item(const std::string& type, const std::string& shape, const std::string& place) {
  return fmt::format("<DataItem Format=\"HDF\" {} Dimensions=\"{}\">{}</DataItem>", type, shape, place);
}

std::string grid_text(const Database& database, const IndexedScene& scene) {
  constexpr const char* kInt = "NumberType=\"Int\" Precision=\"4\"";
  constexpr const char* kFloat = "NumberType=\"Float\" Precision=\"8\"";
  const std::string file = escaped(database.path().filename().string());
  const std::string views = name_of_views(database.path());
  const std::size_t triangles = database.mesh().triangles.size();
  const int nodes = database.mesh().node_count();
  std::string text = fmt::format("  <Grid Name=\"{}\" GridType=\"Uniform\">\n   <Time Value=\"{}\"/>\n",
                                 escaped(scene.name), scene.row);
  text +=
      fmt::format("   <Topology TopologyType=\"Triangle\" NumberOfElements=\"{}\">{}</Topology>\n", triangles,
                  data_item(kInt, fmt::format("{} 3", triangles), file + ":/" + dataset::kTriangles));
  text += fmt::format("   <Geometry GeometryType=\"XY\">{}</Geometry>\n",
                      data_item(kFloat, fmt::format("{} 2", nodes), file + ":/" + dataset::kNodes));
  text += fmt::format(
      "   <Attribute Name=\"displacement\" AttributeType=\"Vector\" Center=\"Node\">{}</Attribute>\n",
      data_item(kFloat, fmt::format("{} 3", nodes), views + ":/" + scene.view()));
  return text + "  </Grid>\n";
}

std::string xdmf_text(const Database& database, const std::vector<IndexedScene>& scenes) {
  std::string text = "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<Xdmf Version=\"3.0\">\n <Domain>\n";
  text += fmt::format(" <Grid Name=\"{}\" GridType=\"Collection\" CollectionType=\"Temporal\">\n",
                      escaped(database.bridge_name()));
  for (const IndexedScene& scene : scenes) text += grid_text(database, scene);
  return text + " </Grid>\n </Domain>\n</Xdmf>\n";
}

void write_views(const Database& database, const std::vector<IndexedScene>& scenes) {
  const auto lock = lock_hdf5();
  Hdf5Output output(index_paths(database.path()).views);
  const auto nodes = static_cast<std::uint64_t>(database.mesh().node_count());
  const std::vector<std::uint64_t> shape = {database.states().size(), database.rows(), nodes, 2};
  for (const IndexedScene& scene : scenes)
    output.add_field_view(scene.view(), database.path().filename().string(), dataset::kField, shape,
                          scene.row);
  output.close();
}

/// The views of an index are none.
bool is_database(const std::filesystem::path& file) {
  return std::filesystem::exists(file) && is_named_database(file);
}

/// Is there one that write_index has written?
bool has_index(const std::filesystem::path& database) {
  std::ifstream stream(index_paths(database).xdmf, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  return text.find(">" + name_of_views(database) + ":/") != std::string::npos;
}

}  // namespace

IndexPaths index_paths(const std::filesystem::path& database) {
  return {std::filesystem::path(database).replace_extension(".xdmf"),
          std::filesystem::path(database).replace_extension(".views.h5")};
}

std::optional<std::filesystem::path> in_the_way_of_index(const std::filesystem::path& database) {
  const IndexPaths paths = index_paths(database);
  if (is_database(paths.views)) return paths.views;
  if (has_index(database)) return std::nullopt;
  for (const std::filesystem::path& path : {paths.xdmf, paths.views})
    if (std::filesystem::exists(path)) return path;
  return std::nullopt;
}

bool remove_index(const std::filesystem::path& database) {
  const IndexPaths paths = index_paths(database);
  if (!has_index(database) || is_database(paths.views)) return false;
  for (const std::filesystem::path& path : {paths.xdmf, paths.views}) {
    std::error_code error;
    std::filesystem::remove(path, error);
    if (error) throw Failure(fmt::format("{}: cannot be removed: {}", path.string(), error.message()));
  }
  return true;
}

void write_index(const Database& database, const std::vector<Scene>& scenes) {
  if (!database.has_fields())
    throw Failure(fmt::format("{}: holds no fields to look at", database.path().string()));
  const auto found = find_scenes(database, scenes);
  write_views(database, found);
  const std::filesystem::path path = index_paths(database.path()).xdmf;
  std::ofstream stream(path, std::ios::binary);
  stream << xdmf_text(database, found) << std::flush;
  if (!stream) throw Failure(fmt::format("{}: cannot be written", path.string()));
}

}  // namespace voussoir
