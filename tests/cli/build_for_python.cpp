#include <catch2/catch.hpp>

#include "database/records/variant_parameters.h"
#include "generator/build.h"
#include "tests/support/bridges.h"
#include "tests/support/made_up_database.h"
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
                      {bridge, "-o", database, "--scenes", "singles;4,1+4,2", "--fields", fields, "--drop"})
                .exit_code == 0);
    const test::ProgramResult result = test::run("/usr/bin/python3", {example, database});
    INFO(result.out << result.err);
    CHECK(result.exit_code == 0);
    CHECK_THAT(result.out, Catch::Contains("bridge 'small', 40 records"));
    CHECK_THAT(result.out, Catch::Contains("40 of 40 right; content digest right"));
  }
}

TEST_CASE("The h5py example finds the checksums of every variant and state right") {
  const test::TemporaryFolder folder;
  const std::string example = std::string(VOUSSOIR_SOURCE_DIR) + "/examples/h5py/read_database.py";
  const auto check = [&](const std::string& database, const std::string& records,
                         const std::string& content) {
    const test::ProgramResult result = test::run("/usr/bin/python3", {example, database});
    INFO(result.out << result.err);
    CHECK(result.exit_code == 0);
    CHECK_THAT(result.out, Catch::Contains(content));
    CHECK_THAT(result.out, Catch::Contains(records + " of " + records + " right; content digest right"));
  };
  BuildRequest request;
  request.bridge = test::small_bridge_file();
  request.output = folder / "two.h5";
  request.scenes = "singles";
  Model stiffer = make_model(request.bridge.description);
  for (std::size_t j = 0; j < stiffer.joints.size(); ++j)
    stiffer.parameters.joints[j].normal_stiffness *= 1.0 + 0.01 * static_cast<double>(j % 7);
  request.other_variants = {variant_parameters(stiffer.parameters)};
  Progress quiet(Progress::Mode::quiet);
  build_database(request, quasi_static(), quiet);
  check(request.output, "78", "variants: 2; states: built");
  test::write_made_up_database(folder / "six.h5", request.bridge, all_scenes(38, 1), KeepField::yes, 3, 2);
  check(folder / "six.h5", "117", "variants: 3; states: built, state 1");
}

TEST_CASE(
    "The XDMF index refers to just the numbers of its scenes, read by Python as its specification says") {
  const test::TemporaryFolder folder;
  const std::string database = (folder / "small.h5").string();
  const std::string bridge = test::example_bridge("small").string();
  const std::string check = std::string(VOUSSOIR_SOURCE_DIR) + "/tests/cli/build_xdmf.py";
  REQUIRE(
      test::run("build-database", {bridge, "-o", database, "--scenes", "singles", "--xdmf", "intact;4,1..3"})
          .exit_code == 0);
  const test::ProgramResult result =
      test::run("/usr/bin/python3", {check, (folder / "small.xdmf").string(), "intact", "4,1", "4,2", "4,3"});
  INFO(result.out << result.err);
  CHECK(result.exit_code == 0);
  CHECK(result.out == "4 grids right\n");
  const test::ProgramResult unknown =
      test::run("build-database", {bridge, "-o", database, "--scenes", "singles", "--xdmf", "4,1+4,2"});
  CHECK(unknown.exit_code == 2);
  CHECK_THAT(unknown.err, Catch::Contains("would not hold scene 4,1+4,2: expected"));
}

}  // namespace voussoir
