/// @file The index for ParaView. Oracle: the rules of XML and of HDF5's paths, written out.

#include "database/records/xdmf.h"

#include <catch2/catch.hpp>

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

}  // namespace voussoir
