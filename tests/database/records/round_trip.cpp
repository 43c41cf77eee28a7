#include <catch2/catch.hpp>
#include <fstream>

#include "core/error.h"
#include "database/format/mapped_file.h"
#include "database/records/database.h"
#include "tests/support/made_up_database.h"
#include "tests/support/temporary_folder.h"

namespace voussoir {
namespace {

bool same_bits(const Field& first, const Field& second) {
  return first.cols() == second.cols() &&
         std::memcmp(first.data(), second.data(), static_cast<std::size_t>(first.size()) * sizeof(double)) ==
             0;
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

TEST_CASE("What is written for each scene is read back bit by bit") {
  const SmallDatabase small;
  const Database database = Database::open(small.path);
  REQUIRE(database.table().rows == small.scenes.size());
  REQUIRE(database.has_fields());
  for (std::size_t row = 0; row < small.scenes.size(); ++row) {
    const Solution expected = test::made_up_solution(small.bridge, small.scenes[row]);
    const Solution stored = database.solution(row);
    REQUIRE(database.table().scene(row) == small.scenes[row]);
    REQUIRE(stored.outcome == expected.outcome);
    REQUIRE(stored.residual == expected.residual);
    REQUIRE(stored.iterations == expected.iterations);
    REQUIRE(same_bits(stored.displacement, expected.displacement));
    REQUIRE(database.find(small.scenes[row]) == row);
    REQUIRE(database.variant(row) == kOnlyVariant);
  }
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
