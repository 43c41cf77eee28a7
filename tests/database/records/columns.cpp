/// @file What is told of a record's columns outside of the one description: database/README.md, the h5py
/// example, a file's own datasets.

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <regex>

#include "database/format/hdf5_file.h"
#include "database/format/hdf5_handle.h"
#include "database/records/columns.h"
#include "database/records/database.h"
#include "database/records/schema.h"
#include "tests/support/bridges.h"
#include "tests/support/file_text.h"
#include "tests/support/hdf5_datasets.h"
#include "tests/support/made_up_database.h"
#include "tests/support/temporary_folder.h"

namespace voussoir {
namespace {

std::string source_text(const std::string& path) {
  return test::text_of(std::filesystem::path(VOUSSOIR_SOURCE_DIR) / path);
}

/// A row of the table of datasets.
struct Row {
  std::string type, shape, units, meaning;
};

std::map<std::string, Row> rows_of_readme() {
  const std::string text = source_text("database/README.md");
  const std::regex line("\\| `([a-z_]+/[a-z_0-9]+)` \\| ([^|]*) \\| ([^|]*) \\| ([^|]*) \\| ([^|]*) \\|\n");
  std::map<std::string, Row> rows;
  for (std::sregex_iterator match(text.begin(), text.end(), line), end; match != end; ++match)
    rows[(*match)[1]] = {(*match)[2], (*match)[3], (*match)[4], (*match)[5]};
  return rows;
}

std::size_t corners_of(const Model& bridge) {
  std::size_t corners = 0;
  for (const Block& block : bridge.layout.blocks) corners += block.polygon.size();
  return corners;
}

/// A database in which all extents are different numbers, so that one cannot stand for another.
struct ManySizes {
  static constexpr std::size_t kScenes = 50, kVariants = 3, kStates = 4;
  test::TemporaryFolder folder;
  std::filesystem::path path = folder / "sizes.h5";
  BridgeFile file = test::small_file_with_sensors();
  Model bridge = make_model(file.description);
  std::map<std::string, std::uint64_t> extents;

  ManySizes() {
    auto scenes = all_scenes(38, 2);
    scenes.resize(kScenes);
    DatabaseContent content = test::made_up_content(file, bridge, scenes, KeepField::yes, kVariants, kStates);
    content.sensitivities = test::made_up_sensitivities(bridge, scenes, kStates);
    test::write_made_up_records(path, content);
    const Database database = Database::open(path);
    extents = {{"R", kScenes * kVariants},
               {"S", kScenes},
               {"Q", kStates},
               {"V", kVariants},
               {"P", bridge.control_points.size()},
               {"P1", test::weight_count(bridge)},
               {"W", places_for(bridge.control_points.size())},
               {"K", database.search_index().clusters()},
               {"K + 1", database.search_index().clusters() + 1},
               {"B", bridge.layout.size()},
               {"C", corners_of(bridge)},
               {"N", static_cast<std::uint64_t>(bridge.mesh.node_count())},
               {"T", bridge.mesh.triangles.size()},
               {"E", bridge.mesh.edges.size()},
               {"J", bridge.joints.size()},
               {"M", 2},
               {"U", 5},
               {"U1", 3},
               {"U2", 2},
               {"F", 2},
               {"F1", 2},
               {"G", content.sensitivities->scenes.size()},
               {"M1", 1},
               {"H1", 4},
               {"H2", 5},
               {"H3", 6},
               {"H4", 2},
               {"H5", 3},
               {"Q G", kStates * 39},
               {"Q G + 1", kStates * 39 + 1},
               {"L", 2 * (kStates * 38 - 7)}};  // seven singles are unknown in the last state
  }

  /// "R x 2" -> {150, 2}
  std::vector<std::uint64_t> shape_in_words(const std::string& shape) const {
    std::vector<std::uint64_t> numbers;
    for (std::size_t start = 0; start < shape.size();) {
      const std::size_t end = std::min(shape.find(" x ", start), shape.size());
      const std::string extent = shape.substr(start, end - start);
      numbers.push_back(extents.contains(extent) ? extents.at(extent) : std::stoull(extent));
      start = end + 3;
    }
    return numbers;
  }
};

/// A dataset as the HDF5 library finds it.
struct Found {
  std::string type;
  std::vector<std::uint64_t> shape;
  std::string units, meaning;
};

std::string type_name(hid_t type) {
  const std::size_t width = H5Tget_size(type);
  if (H5Tget_class(type) == H5T_STRING) return width == 1 ? "text" : fmt::format("text ({})", width);
  if (H5Tget_class(type) == H5T_FLOAT) return fmt::format("float{}", 8 * width);
  return fmt::format("{}int{}", H5Tget_sign(type) == H5T_SGN_NONE ? "u" : "", 8 * width);
}

std::string text_attribute(hid_t object, const char* name) {
  const Hdf5Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  const Hdf5Handle type(H5Aget_type(attribute.get()), H5Tclose);
  std::string text(H5Tget_size(type.get()), '\0');
  REQUIRE(H5Aread(attribute.get(), type.get(), text.data()) >= 0);
  return text;
}

Found look_at(hid_t file, const std::string& path) {
  const Hdf5Handle dataset(H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose);
  const Hdf5Handle type(H5Dget_type(dataset.get()), H5Tclose);
  const Hdf5Handle space(H5Dget_space(dataset.get()), H5Sclose);
  std::array<hsize_t, 8> extents{};
  const int rank = H5Sget_simple_extent_dims(space.get(), extents.data(), nullptr);
  Found found{type_name(type.get()),
              {extents.begin(), extents.begin() + rank},
              text_attribute(dataset.get(), "units"),
              text_attribute(dataset.get(), "meaning")};
  if (rank == 0) found.type = "text";  // as long as the text
  return found;
}

/// The texts between quotation marks in the Python list of this name.
std::vector<std::string> python_list(const std::string& name) {
  const std::string text = source_text("examples/h5py/read_database.py");
  const std::size_t begin = text.find("\n" + name + " = [");
  REQUIRE(begin != std::string::npos);
  const std::string list = text.substr(begin, text.find(']', begin) - begin);
  const std::regex quoted("\"([^\"]*)\"");
  std::vector<std::string> texts;
  for (std::sregex_iterator match(list.begin(), list.end(), quoted), end; match != end; ++match)
    texts.push_back((*match)[1]);
  return texts;
}

template <class Condition>
std::vector<std::string> columns_that(const Condition& condition) {
  std::vector<std::string> paths;
  for (const Column& column : record_columns())
    if (condition(column)) paths.emplace_back(column.path);
  return paths;
}

}  // namespace

TEST_CASE("The table in database/README.md says of every dataset what a file says of it") {
  const ManySizes many;
  const auto rows = rows_of_readme();
  const auto lock = lock_hdf5();
  const Hdf5Handle file(H5Fopen(many.path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  const auto paths = test::dataset_paths(file.get());
  CHECK(paths.size() > 40);
  for (const std::string& path : paths) {
    INFO(path);
    REQUIRE(rows.contains(path));
    const Row& row = rows.at(path);
    const Found found = look_at(file.get(), path);
    CHECK(row.type == found.type);
    if (row.shape != "any") CHECK(many.shape_in_words(row.shape) == found.shape);
    CHECK(row.units == found.units);
    CHECK(row.meaning == found.meaning);
  }
  for (const auto& [path, row] : rows) {
    INFO(path);
    CHECK(std::ranges::count(paths, path) == 1);
  }
}

TEST_CASE("A file's columns are those of the description, with its types, shapes and words") {
  const ManySizes many;
  const Hdf5File file(many.path);
  const Sizes sizes{ManySizes::kStates,
                    ManySizes::kScenes * ManySizes::kVariants,
                    2,
                    many.bridge.control_points.size(),
                    many.bridge.layout.size(),
                    static_cast<std::uint64_t>(many.bridge.mesh.node_count()),
                    many.bridge.joints.size()};
  for (const Column& column : record_columns()) {
    INFO(column.path);
    if (column.in_chunks())
      CHECK_NOTHROW(file.open_chunked(column.path, shape_of(column, sizes)));
    else
      CHECK_NOTHROW(file.array(column.path, column.type, shape_of(column, sizes)));
  }
}

TEST_CASE("database/README.md says which text the digest begins with and which version the schema has") {
  const std::string text = source_text("database/README.md");
  CHECK_THAT(text, Catch::Contains(fmt::format("\"{} {}\\n\"", kFormatName, kSchemaVersion)));
  CHECK_THAT(text, Catch::Contains(fmt::format("Schema version {}.", kSchemaVersion)));
  CHECK_THAT(text, Catch::Contains(fmt::format("| `schema_version` | int32 | {};", kSchemaVersion)));
}

TEST_CASE("The h5py example and database/README.md name the columns in the checksum in their order") {
  const auto of_record = columns_that([](const Column& c) { return c.in_checksum && !c.of_state(); });
  const auto of_state = columns_that([](const Column& c) { return c.in_checksum && c.of_state(); });
  CHECK(python_list("RECORD_COLUMNS") == of_record);
  CHECK(python_list("STATE_COLUMNS") == of_state);
  CHECK(python_list("OPTIONAL") == columns_that([](const Column& c) { return c.optional; }));
  CHECK(python_list("PADDED") == columns_that([](const Column& c) { return c.form == Form::padded; }));
  CHECK(python_list("MARKS") == columns_that([](const Column& c) { return c.form == Form::marks; }));
  std::string section = source_text("database/README.md");
  section = section.substr(section.find("## Checksums and digest"));
  std::size_t place = section.find("the number of states (uint32)");
  for (const auto& paths : {of_record, of_state})
    for (const std::string& path : paths) {
      INFO(path);
      const std::size_t next = section.find("`" + path + "`", place);
      REQUIRE(next != std::string::npos);
      place = next;
    }
}

TEST_CASE("The h5py example names the datasets in the digest in their order") {
  const BridgeFile file = test::small_bridge_file();
  const Model bridge = make_model(file.description);
  std::vector<std::string> expected;
  const Sensitivities sensitivities = test::made_up_sensitivities(bridge, all_scenes(38, 1), 1);
  for (const DatasetValue& value :
       shared_datasets(test::made_up_provenance(file), bridge, {test::made_up_parameters(bridge, 0)},
                       {kBuiltState}, {}, &sensitivities))
    expected.push_back(value.path);
  CHECK_THAT(source_text("database/README.md"), Catch::Contains("`" + expected.back() + "` in the order"));
  expected.emplace_back(dataset::kChecksum);
  CHECK(python_list("DIGEST_ORDER") == expected);
}

TEST_CASE("Values that do not fit into a row are an error and a row of another form is refused") {
  const Column& removed = column_at(dataset::kRemoved);
  const Column& moving = column_at(dataset::kMoving);
  const std::vector<std::int32_t> list = {0, 2};
  Bytes row(3 * sizeof(std::int32_t));
  write_row(removed, view_bytes(list), row);
  CHECK(read_row(removed, row) == Bytes(view_bytes(list).begin(), view_bytes(list).end()));
  CHECK_THROWS_AS(write_row(removed, view_bytes(list), std::span(row).first(4)), std::logic_error);
  const std::vector<std::int32_t> gap = {0, -1, 2};
  CHECK_FALSE(read_row(removed, view_bytes(gap)).has_value());
  Bytes marks(3);
  write_row(moving, view_bytes(list), marks);
  CHECK(marks == Bytes{std::byte{1}, std::byte{0}, std::byte{1}});
  CHECK(read_row(moving, marks) == Bytes(view_bytes(list).begin(), view_bytes(list).end()));
  CHECK_THROWS_AS(write_row(moving, view_bytes(list), std::span(marks).first(2)), std::logic_error);
  marks[1] = std::byte{2};
  CHECK_FALSE(read_row(moving, marks).has_value());
}

}  // namespace voussoir
