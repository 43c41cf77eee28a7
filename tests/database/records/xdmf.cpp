/// @file The index for ParaView. Oracle: the rules of XML and of HDF5's paths, written out.

#include "database/records/xdmf.h"

#include <catch2/catch.hpp>
#include <fstream>

#include "tests/support/file_text.h"
#include "tests/support/made_up_database.h"
#include "tests/support/temporary_folder.h"

namespace voussoir {

TEST_CASE("Labels that mean something in XML or in a path are names of scenes like any other") {
  const test::TemporaryFolder folder;
  const BridgeFile file = parse_bridge_file(
      "blocks = [{label = \"a<b\", vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]},\n"
      "  {label = \"c/d\", vertices = [[0, 1], [1, 1], [1, 2], [0, 2]]}]\n",
      "odd.toml");
  test::write_made_up_database(folder / "odd.h5", file, all_scenes(2, 1), KeepField::yes);
  const Database database = Database::open(folder / "odd.h5");
  write_index(database, all_scenes(2, 1));
  const std::string text = test::text_of(folder / "odd.xdmf");
  CHECK_THAT(text, Catch::Contains("<Grid Name=\"a&lt;b\"") && Catch::Contains("<Grid Name=\"c/d\""));
  for (const char* label : {"a<b", "c/d"}) {
    const std::size_t row = *database.find(parse_scene(label, database.layout()));
    CHECK_THAT(text, Catch::Contains(fmt::format(">odd.views.h5:/{}</DataItem>", row)));
  }
}

TEST_CASE("An index is removed with its views, and a file of another program that has its name stays") {
  const test::TemporaryFolder folder;
  test::write_made_up_database(folder / "small.h5", test::small_bridge_file(), all_scenes(38, 1),
                               KeepField::yes);
  write_index(Database::open(folder / "small.h5"), all_scenes(38, 1));
  CHECK_FALSE(in_the_way_of_index(folder / "small.h5"));
  CHECK(remove_index(folder / "small.h5"));
  CHECK_FALSE(std::filesystem::exists(folder / "small.xdmf"));
  CHECK_FALSE(std::filesystem::exists(folder / "small.views.h5"));
  CHECK_FALSE(remove_index(folder / "small.h5"));
  CHECK_FALSE(in_the_way_of_index(folder / "small.h5"));
  std::ofstream(folder / "small.xdmf") << "<Xdmf Version=\"3.0\"/>";
  CHECK(in_the_way_of_index(folder / "small.h5") == folder / "small.xdmf");
  CHECK_FALSE(remove_index(folder / "small.h5"));
  CHECK(std::filesystem::exists(folder / "small.xdmf"));
}

}  // namespace voussoir
