/// @file Bridges that are found again in databases. Oracle: the bridge that was stored.

#include "database/records/stored_bridge.h"

#include <catch2/catch.hpp>

#include "tests/support/bridges.h"
#include "tests/support/file_text.h"
#include "tests/support/made_up_database.h"
#include "tests/support/temporary_folder.h"

namespace voussoir {

TEST_CASE("A stored bridge is held as the one that was stored, at its top and in its embedded courses, too") {
  const test::TemporaryFolder folder;
  for (const std::string supports :
       {"", "[supports]\ntop = \"clamped\"\n",
        "[supports]\nbase = \"roller\"\ntop = \"roller\"\nembedded_courses = 1\n"}) {
    INFO(supports);
    const BridgeFile file =
        parse_bridge_file(test::text_of(test::example_bridge("small")) + supports, "small.toml");
    const Model bridge = make_model(file.description);
    test::write_made_up_database(folder / "small.h5", file, {Scene{}}, KeepField::yes);
    const Model stored = bridge_of(Database::open(folder / "small.h5"));
    REQUIRE(stored.supports.size() == bridge.supports.size());
    for (std::size_t s = 0; s < bridge.supports.size(); ++s) {
      const Support &found = stored.supports[s], &expected = bridge.supports[s];
      CHECK(found.name == expected.name);
      CHECK(found.nodes == expected.nodes);
      CHECK(found.holds_x == expected.holds_x);
      CHECK(found.holds_y == expected.holds_y);
      CHECK(found.is_foot == expected.is_foot);
    }
    CHECK(stored.parameters.joints == bridge.parameters.joints);
  }
}

}  // namespace voussoir
