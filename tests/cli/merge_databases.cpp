/// @file build-database --shard and merge-databases as a user runs them. Oracle: the digest of one build.

#include <fmt/format.h>
#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/bridges.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

namespace voussoir {
namespace {

struct MergeSite {
  test::TemporaryFolder folder;

  std::string file(const std::string& name) const { return (folder / name).string(); }

  /// The digest of what is built.
  std::string build(const std::string& name, std::vector<std::string> more) const {
    std::vector<std::string> arguments = {test::example_bridge("small").string(), "-o", file(name)};
    for (const char* word :
         {"--scenes", "singles;4,1+*,1..2", "--history", "built,lost", "--quiet", "--format", "json"})
      arguments.emplace_back(word);
    arguments.insert(arguments.end(), more.begin(), more.end());
    const test::ProgramResult result = test::run("build-database", arguments);
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    return nlohmann::json::parse(result.out)["digest"].get<std::string>();
  }

  test::ProgramResult merge(const std::vector<std::string>& parts) const {
    std::vector<std::string> arguments = {"-o", file("merged.h5"), "--quiet", "--format", "json"};
    for (const std::string& part : parts) arguments.push_back(file(part));
    return test::run("merge-databases", arguments);
  }
};

}  // namespace

TEST_CASE("Parts that the programs build and merge give the database of one build", "[many-solutions]") {
  const MergeSite site;
  const std::string whole = site.build("whole.h5", {});
  for (const char* part : {"2/3", "3/3", "1/3"})
    site.build(fmt::format("part{}.h5", part[0]), {"--shard", part});
  const test::ProgramResult incomplete = site.merge({"part3.h5", "part2.h5"});
  CHECK(incomplete.exit_code == 2);
  CHECK_THAT(incomplete.err, Catch::Contains("not among the files: 1"));
  const test::ProgramResult merged = site.merge({"part3.h5", "part1.h5", "part2.h5"});
  INFO(merged.err);
  REQUIRE(merged.exit_code == 0);
  CHECK(nlohmann::json::parse(merged.out)["digest"] == whole);
}

TEST_CASE("A part is verified like a database, but answers no readings") {
  const MergeSite site;
  site.build("part2.h5", {"--shard", "2/3"});
  CHECK(test::run("verify-database", {site.file("part2.h5"), "--recompute", "3"}).exit_code == 0);
  std::ofstream(site.file("readings.csv")) << "point,uy_mm\nT1,-0.1\n";
  const test::ProgramResult answer =
      test::run("locate-damage", {site.file("readings.csv"), "-d", site.file("part2.h5")});
  CHECK(answer.exit_code == 1);
  CHECK_THAT(answer.err, Catch::Contains("part 2/3 of a database"));
  for (const char* part : {"4/3", "0/3", "3", "a/b"})
    CHECK(test::run("build-database", {"--shard", part}).exit_code == 2);
}

}  // namespace voussoir
