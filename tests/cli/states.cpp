/// @file Histories and load cases through the real programs.

#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "database/records/database.h"
#include "tests/support/bridges.h"
#include "tests/support/file_text.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

namespace voussoir {
namespace {

/// The small bridge with a lorry that passes in two steps.
struct Site {
  test::TemporaryFolder folder;
  std::string bridge = (folder / "loaded.toml").string();
  std::string database = (folder / "loaded.h5").string();

  Site() {
    std::ofstream(bridge)
        << test::text_of(test::example_bridge("small"))
        << "[[loads]]\nname = \"lorry\"\naxles = [{at_m = 0, force_N = 1e4}]\nfrom_m = 2\nto_m = "
           "4\nsteps = 2\n";
  }
  test::ProgramResult build(std::vector<std::string> options) const {
    options.insert(options.begin(), {bridge, "-o", database, "--scenes", "singles;4,1+4,2", "--quiet"});
    return test::run("build-database", options);
  }
};

}  // namespace

TEST_CASE("Programs build, verify and show states, and Python finds their checksums right by itself") {
  const Site site;
  const test::ProgramResult built =
      site.build({"--history", "built,lost", "--loads", "all", "--format", "json"});
  REQUIRE(built.exit_code == 0);
  const auto summary = nlohmann::json::parse(built.out);
  const std::vector<std::string> names = {"built",         "lost",         "built:lorry@1",
                                          "built:lorry@2", "lost:lorry@1", "lost:lorry@2"};
  REQUIRE(summary["states"].size() == names.size());
  for (std::size_t i = 0; i < names.size(); ++i) CHECK(summary["states"][i]["state"] == names[i]);
  CHECK(summary["standing"] == summary["states"][0]["standing"]);
  const auto verified = nlohmann::json::parse(
      test::run("verify-database", {site.database, "--recompute", "5", "--format", "json"}).out);
  CHECK(verified["ok"] == true);
  CHECK(verified["fields"] == 40 * names.size());
  const std::string example = std::string(VOUSSOIR_SOURCE_DIR) + "/examples/h5py/read_database.py";
  const test::ProgramResult python = test::run("/usr/bin/python3", {example, site.database});
  INFO(python.out << python.err);
  CHECK(python.exit_code == 0);
  CHECK_THAT(python.out,
             Catch::Contains("40 of 40 right; content digest right") && Catch::Contains("lost:lorry@2: "));
}

TEST_CASE("query-field shows the field of the state that is asked for (compared with the file)") {
  const Site site;
  REQUIRE(site.build({"--history", "lost,built", "--loads", "lorry"}).exit_code == 0);
  const Database database = Database::open(site.database);
  const auto crown = [&](const std::vector<std::string>& options) {
    std::vector<std::string> all = {"4,2", "-d", site.database, "--at", "T6", "--format", "json"};
    all.insert(all.end(), options.begin(), options.end());
    return nlohmann::json::parse(test::run("query-field", all).out)[0]["uy_m"].get<double>();
  };
  const auto stored = [&](const char* state) {
    const SceneTable table = database.table(kNominalVariant, *database.find_state(state));
    return table.row(*database.find(parse_scene("4,2", database.layout())))[5];
  };
  CHECK(crown({}) == stored("built"));
  CHECK(crown({"--history", "lost"}) == stored("lost"));
  CHECK(crown({"--load", "lorry@2"}) == stored("built:lorry@2"));
  CHECK(crown({"--history", "lost", "--load", "lorry@1"}) == stored("lost:lorry@1"));
  const test::ProgramResult picture =
      test::run("query-field", {"4,2", "-d", site.database, "--history", "lost", "--format", "svg"});
  CHECK_THAT(picture.out, Catch::Contains("without 4,2 as lost, standing"));
  const test::ProgramResult unknown =
      test::run("query-field", {"4,2", "-d", site.database, "--load", "lorry"});
  CHECK(unknown.exit_code == 2);
  CHECK_THAT(unknown.err, Catch::Contains("'built:lorry'") && Catch::Contains("built:lorry@1"));
}

TEST_CASE("States and numbers that cannot be are bad usage") {
  const Site site;
  const auto refused = [&](const std::vector<std::string>& options, const char* why) {
    const test::ProgramResult result = site.build(options);
    INFO(result.err);
    CHECK(result.exit_code == 2);
    CHECK_THAT(result.err, Catch::Contains(why));
  };
  refused({"--history", "gone"}, "expected built, lost or built,lost");
  refused({"--loads", "bus"}, "expected all, none or names of its load cases (lorry)");
  refused({"--solver", "dynamic", "--history", "lost"}, "expected --history built and --loads none");
  refused({"--solver", "dynamic", "--loads", "all"}, "expected --history built and --loads none");
  for (const char* option : {"--step", "--ramp", "--damping", "--patience", "--rest"})
    for (const char* number : {"nan", "-1", "inf", "fast"}) refused({option, number}, number);
  CHECK_FALSE(std::filesystem::exists(site.database));
  for (const char* option : {"--recompute", "--seed", "--threads"})
    for (const char* number : {"nan", "-1", "inf"})
      CHECK(test::run("verify-database", {site.database, option, number}).exit_code == 2);
}

TEST_CASE(
    "build-database draws variants by their seed and solves their singles; verify-database finds them "
    "right") {
  const test::TemporaryFolder folder;
  const std::string bridge = test::example_bridge("small").string();
  const auto build = [&](const std::string& name, std::vector<std::string> options) {
    options.insert(options.begin(), {bridge, "-o", (folder / name).string(), "--format", "json", "--quiet",
                                     "--variants", "2", "--history", "built,lost"});
    return nlohmann::json::parse(test::run("build-database", options).out);
  };
  const std::vector<std::string> few = {"--scenes", "intact;4,2..3;4,2+4,3"};
  auto other = few, threads = few;
  other.insert(other.end(), {"--variant-seed", "2"});
  threads.insert(threads.end(), {"--threads", "1"});
  const auto summary = build("few.h5", few);
  CHECK(summary["scenes"] == 3 * 4);
  CHECK(build("threads.h5", threads)["digest"] == summary["digest"]);
  CHECK(build("other.h5", other)["digest"] != summary["digest"]);
  const Database database = Database::open(folder / "few.h5");
  CHECK(database.variant_count() == 3);
  CHECK(Database::open(folder / "other.h5").variants()[1] != database.variants()[1]);
  const auto verified = nlohmann::json::parse(
      test::run("verify-database", {(folder / "few.h5").string(), "--recompute", "12", "--format", "json"})
          .out);
  CHECK(verified["ok"] == true);
  CHECK(verified["recomputed"] == 12);
}

}  // namespace voussoir
