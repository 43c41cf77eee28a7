#include <catch2/catch.hpp>

#include "database/database.h"
#include "tests/support/bridges.h"
#include "tests/support/program.h"

namespace voussoir {

TEST_CASE(
    "The h5py example reads a database and finds its checksums and digest right, computed by Python alone") {
  const test::TemporaryFolder folder;
  const std::string database = (folder / "small.h5").string();
  const std::string bridge = test::example_bridge("small").string();
  const std::string example = std::string(VOUSSOIR_SOURCE_DIR) + "/examples/h5py/read_database.py";
  for (const char* fields : {"all", "none"}) {
    REQUIRE(test::run("build-database",
                      {bridge, "-o", database, "--scenes", "singles;4,1+4,2", "--fields", fields})
                .exit_code == 0);
    const test::ProgramResult result = test::run("/usr/bin/python3", {example, database});
    INFO(result.out << result.err);
    CHECK(result.exit_code == 0);
    CHECK_THAT(result.out, Catch::Contains("bridge 'small', 40 scenes"));
    CHECK_THAT(result.out, Catch::Contains("40 of 40 right; content digest right"));
  }
}

}  // namespace voussoir
