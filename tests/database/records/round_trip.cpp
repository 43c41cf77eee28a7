#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>
#include <fstream>
#include <limits>

#include "core/error.h"
#include "database/format/mapped_file.h"
#include "database/records/database.h"
#include "database/records/schema.h"
#include "database/search/stored_index.h"
#include "tests/support/made_up_database.h"
#include "tests/support/same_bits.h"
#include "tests/support/temporary_folder.h"

namespace voussoir {
namespace {

void check_same(const RecordedState& stored, const RecordedState& expected) {
  REQUIRE(stored.outcome == expected.outcome);
  REQUIRE(stored.residual == expected.residual);
  REQUIRE(stored.iterations == expected.iterations);
  REQUIRE(stored.extent == expected.extent);
  REQUIRE(stored.moving == expected.moving);
  REQUIRE(std::ranges::equal(view_bytes(stored.vertical), view_bytes(expected.vertical)));
  REQUIRE(stored.packed_field == expected.packed_field);
  REQUIRE(stored.field_crc == expected.field_crc);
  REQUIRE(stored.slipped == expected.slipped);
}

struct SmallDatabase {
  test::TemporaryFolder folder;
  BridgeFile file = test::small_bridge_file();
  Model bridge = make_model(file.description);
  std::vector<Scene> scenes = all_scenes(bridge.layout.size(), 2);
  std::filesystem::path path = folder / "small.h5";
  WrittenDatabase written;

  explicit SmallDatabase(KeepField fields = KeepField::yes)
      : written(test::write_made_up_database(path, file, scenes, fields)) {}
};

}  // namespace

TEST_CASE("What is written of each record is read back bit by bit, for every variant and state") {
  const test::TemporaryFolder folder;
  const BridgeFile file = test::small_bridge_file();
  const Model bridge = make_model(file.description);
  const auto content = test::made_up_content(file, bridge, all_scenes(38, 1), KeepField::yes, 3, 2);
  test::write_made_up_database(folder / "three.h5", file, all_scenes(38, 1), KeepField::yes, 3, 2);
  const Database database = Database::open(folder / "three.h5");
  REQUIRE(database.rows() == content.keys.size());
  REQUIRE(database.states() == content.states);
  REQUIRE(database.has_fields());
  int moving = 0, slipped = 0;
  for (std::size_t row = 0; row < database.rows(); ++row) {
    const RecordKey& key = content.keys[row];
    const Record stored = database.record(row);
    const Record expected = test::made_up_record(bridge, key, 2, KeepField::yes);
    REQUIRE(database.key(row) == key);
    REQUIRE(database.find(key.variant, key.scene) == row);
    REQUIRE(stored.key == key);
    REQUIRE(stored.checksum == expected.checksum);
    REQUIRE(stored.states.size() == 2);
    for (std::size_t state = 0; state < 2; ++state) {
      check_same(stored.states[state], expected.states[state]);
      const auto field = unpack_field(expected.states[state].packed_field, bridge.mesh.node_count());
      REQUIRE(test::same_bits(database.field(row, state), *field));
      moving += expected.states[state].moving.empty() ? 0 : 1;
      slipped += expected.states[state].slipped.empty() ? 0 : 1;
    }
  }
  CHECK(moving > 0);
  CHECK(slipped > 0);
  CHECK_FALSE(database.find(3, Scene{}).has_value());
}

TEST_CASE("The table of a variant in a state lies in the file in one piece and is that of its records") {
  const test::TemporaryFolder folder;
  const auto scenes = all_scenes(38, 1);
  test::write_made_up_database(folder / "many.h5", test::small_bridge_file(), scenes, KeepField::no, 3, 2);
  const Database database = Database::open(folder / "many.h5");
  const ByteView whole = database.dataset_bytes(dataset::kVertical);
  for (std::int32_t variant = 0; variant < 3; ++variant)
    for (std::size_t state = 0; state < 2; ++state) {
      const SceneTable table = database.table(variant, state);
      REQUIRE(table.rows == scenes.size());
      const std::size_t before =
          (3 * state + static_cast<std::size_t>(variant)) * table.vertical.size_bytes();
      CHECK(reinterpret_cast<const std::byte*>(table.vertical.data()) == whole.data() + before);
      for (std::size_t row = 0; row < table.rows; ++row) {
        const Record record = database.record(table.first_record + row);
        REQUIRE(record.key == RecordKey{variant, table.scene(row)});
        REQUIRE(std::ranges::equal(view_bytes(record.states[state].vertical), std::as_bytes(table.row(row))));
        REQUIRE(static_cast<std::uint8_t>(record.states[state].outcome) == table.outcome[row]);
        REQUIRE(static_cast<std::uint8_t>(record.states[state].extent) == table.collapse[row]);
      }
    }
  CHECK(database.table().vertical.data() == database.table(0, 0).vertical.data());
  CHECK(database.table().rows == scenes.size());
  CHECK_THROWS_WITH(database.table(3, 0), Catch::Contains("no variant 3 (0 to 2 exist)"));
  CHECK_THROWS_WITH(database.table(-1, 0), Catch::Contains("no variant -1"));
  CHECK_THROWS_WITH(database.table(0, 2), Catch::Contains("no state 2 (0 to 1 exist)"));
}

TEST_CASE("Each history has a search index, made of its own rows (computed anew), and load cases have none") {
  const test::TemporaryFolder folder;
  const BridgeFile file = test::small_bridge_file();
  const Model bridge = make_model(file.description);
  DatabaseContent content = test::made_up_content(file, bridge, all_scenes(38, 1), KeepField::no, 2, 3);
  content.states = {kBuiltState, kLostState, state_name(kLostState, "truck@1")};
  write_database(folder / "three.h5", content, [&](std::size_t row) {
    return test::made_up_record(bridge, content.keys[row], 3, KeepField::no);
  });
  const Database database = Database::open(folder / "three.h5");
  CHECK(database.find_state("lost:truck@1") == 2);
  CHECK_FALSE(database.find_state("lost:truck"));
  for (std::size_t state = 0; state < 2; ++state) {
    const SceneTable table = database.table(kNominalVariant, state);
    CHECK(database.search_index(state).row.size() == table.rows);
    for (const DatasetValue& value : search_datasets(content.states[state], table.vertical, table.points))
      CHECK(std::ranges::equal(value.bytes, database.dataset_bytes(value.path.c_str())));
  }
  CHECK(&database.search_index() == &database.search_index(0));
  CHECK_THROWS_AS(database.search_index(2), InputError);
}

TEST_CASE(
    "A bridge of which nothing stands has an index of no scenes, and can be opened and searched (all NaN)") {
  const test::TemporaryFolder folder;
  const BridgeFile file = test::small_bridge_file();
  const Model bridge = make_model(file.description);
  const DatabaseContent content = test::made_up_content(file, bridge, all_scenes(38, 1), KeepField::no);
  write_database(folder / "fallen.h5", content, [&](std::size_t row) {
    Record record = test::made_up_record(bridge, content.keys[row], 1, KeepField::no);
    std::ranges::fill(record.states[0].vertical, std::numeric_limits<double>::quiet_NaN());
    return record;
  });
  const Database database = Database::open(folder / "fallen.h5");
  CHECK(database.search_index().clusters() == 0);
  CHECK(database.search_index().row.empty());
  CHECK(database.search_index().first.size() == 1);
}

TEST_CASE("The variants' parameters and the joints that they belong to are read back as they were written") {
  const test::TemporaryFolder folder;
  const BridgeFile file = test::small_bridge_file();
  const Model bridge = make_model(file.description);
  test::write_made_up_database(folder / "four.h5", file, {Scene{}}, KeepField::no, 4);
  const Database database = Database::open(folder / "four.h5");
  REQUIRE(database.variant_count() == 4);
  REQUIRE(database.variants().size() == 4);
  for (std::size_t variant = 0; variant < 4; ++variant)
    CHECK(database.variants()[variant] == test::made_up_parameters(bridge, variant));
  REQUIRE(database.joints().size() == bridge.joints.size());
  for (std::size_t i = 0; i < bridge.joints.size(); ++i) {
    const Joint& stored = database.joints()[i];
    const Joint& expected = bridge.joints[i];
    CHECK(stored.first == expected.first);
    CHECK(stored.second == expected.second);
    CHECK(stored.first_edge.from == expected.first_edge.from);
    CHECK(stored.first_edge.to == expected.first_edge.to);
    CHECK(stored.second_edge.from == expected.second_edge.from);
    CHECK(stored.second_edge.to == expected.second_edge.to);
    CHECK(stored.first_at == expected.first_at);
    CHECK(stored.second_at == expected.second_at);
    CHECK(stored.length == expected.length);
  }
}

TEST_CASE("A bridge of a single block, which has no joints, is written and read") {
  const test::TemporaryFolder folder;
  const BridgeFile file = parse_bridge_file(
      "spans = []\n[wall]\ncourses = 1\nlength_m = 1.0\nbond = \"stack\"\n[control_points]\narch = false\n",
      "one block");
  REQUIRE(make_model(file.description).joints.empty());
  test::write_made_up_database(folder / "one.h5", file, {Scene{}}, KeepField::yes, 2);
  const Database database = Database::open(folder / "one.h5");
  CHECK(database.joints().empty());
  CHECK(database.variants().at(1).normal_stiffness.empty());
  CHECK(database.variants().at(1).density.size() == 1);
}

TEST_CASE("The control table holds the vertical displacements of the stored fields at the control points") {
  const SmallDatabase small;
  const Database database = Database::open(small.path);
  const SceneTable& table = database.table();
  REQUIRE(table.points == small.bridge.control_points.size());
  for (std::size_t row = 0; row < table.rows; ++row) {
    const Field field = database.field(row);
    for (std::size_t i = 0; i < table.points; ++i) {
      const double expected = field(1, value(small.bridge.control_points[i].node));
      const bool gone = small.scenes[row].lacks(small.bridge.control_points[i].block);
      REQUIRE(std::isnan(table.row(row)[i]) == gone);
      if (!gone) REQUIRE(table.row(row)[i] == expected);
    }
  }
}

TEST_CASE("Blocks, mesh, control points and bridge text are read back as they were written") {
  const SmallDatabase small;
  const Database database = Database::open(small.path);
  const BlockLayout& layout = database.layout();
  REQUIRE(layout.size() == small.bridge.layout.size());
  for (std::size_t i = 0; i < layout.size(); ++i) {
    CHECK(layout.blocks[i].index == small.bridge.layout.blocks[i].index);
    CHECK(layout.blocks[i].kind == small.bridge.layout.blocks[i].kind);
    CHECK(layout.blocks[i].polygon == small.bridge.layout.blocks[i].polygon);
    CHECK(layout.blocks[i].top_course == small.bridge.layout.blocks[i].top_course);
    CHECK(database.mesh().block_triangles[i].end == small.bridge.mesh.block_triangles[i].end);
  }
  CHECK(database.mesh().nodes == small.bridge.mesh.nodes);
  REQUIRE(database.mesh().triangles.size() == small.bridge.mesh.triangles.size());
  CHECK(database.mesh().edges.size() == small.bridge.mesh.edges.size());
  REQUIRE(database.control_points().size() == small.bridge.control_points.size());
  CHECK(database.control_points().back().name == small.bridge.control_points.back().name);
  CHECK(database.control_points().back().position == small.bridge.control_points.back().position);
  CHECK(database.bridge_text() == small.file.text);
  CHECK(database.bridge_name() == "small");
  CHECK(database.digest() == small.written.digest);
  CHECK(differences(database.provenance(), test::made_up_provenance(small.file)).empty());
}

TEST_CASE("Writing the same content twice gives the same bytes") {
  const SmallDatabase first;
  const SmallDatabase second;
  const MappedFile a(first.path);
  const MappedFile b(second.path);
  REQUIRE(a.bytes().size() == b.bytes().size());
  CHECK(std::memcmp(a.bytes().data(), b.bytes().data(), a.bytes().size()) == 0);
}

TEST_CASE("A database without fields has the same control table and says that it holds no fields") {
  const SmallDatabase with;
  const SmallDatabase without(KeepField::no);
  const Database database = Database::open(without.path);
  CHECK_FALSE(database.has_fields());
  CHECK_THROWS_WITH(database.field(0), Catch::Contains("holds no fields"));
  CHECK(database.digest() != with.written.digest);
  const Database full = Database::open(with.path);
  CHECK(std::memcmp(database.table().vertical.data(), full.table().vertical.data(),
                    full.table().vertical.size_bytes()) == 0);
}

TEST_CASE("The digest depends on scenes, bridge text and settings, not on provenance of the program") {
  const test::TemporaryFolder folder;
  BridgeFile file = test::small_bridge_file();
  const auto scenes = all_scenes(38, 1);
  const std::string digest = test::write_made_up_database(folder / "a.h5", file, scenes).digest;
  CHECK(test::write_made_up_database(folder / "b.h5", file, {scenes.begin(), scenes.end() - 1}).digest !=
        digest);
  file.text += "# one more remark\n";
  CHECK(test::write_made_up_database(folder / "c.h5", file, scenes).digest != digest);
}

TEST_CASE("Files that are no database are refused with the file's name and what was expected") {
  const test::TemporaryFolder folder;
  CHECK_THROWS_AS(Database::open(folder / "missing.h5"), Failure);
  CHECK_THROWS_WITH(Database::open(folder / "missing.h5"), Catch::Contains("missing.h5: cannot be read"));
  CHECK_THROWS_AS(Database::open(folder.path()), Failure);
  std::ofstream(folder / "text.h5") << "point,uy_mm\nT1,-1\n";
  CHECK_THROWS_AS(Database::open(folder / "text.h5"), InputError);
  CHECK_THROWS_WITH(Database::open(folder / "text.h5"), Catch::Contains("no database"));
  std::ofstream(folder / "empty.h5").flush();
  CHECK_THROWS_AS(Database::open(folder / "empty.h5"), InputError);
}

TEST_CASE("A database cut off anywhere is refused") {
  const SmallDatabase small;
  const std::uintmax_t size = std::filesystem::file_size(small.path);
  for (const double share : {0.999, 0.9, 0.5, 0.1, 0.01, 0.0001}) {
    std::filesystem::resize_file(small.path, static_cast<std::uintmax_t>(share * static_cast<double>(size)));
    CHECK_THROWS_AS(Database::open(small.path), InputError);
  }
}

}  // namespace voussoir
