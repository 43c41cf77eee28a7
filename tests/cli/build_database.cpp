/// @file build-database as people run it: killed, on full disks, twice at once. Oracle: the digest of an
/// undisturbed build; what a shell sees (exit code, streams, the files that are there).

#include <catch2/catch.hpp>
#include <chrono>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "core/text_file.h"
#include "database/format/sha256.h"
#include "database/records/database.h"
#include "database/records/journal.h"
#include "tests/support/answer.h"
#include "tests/support/bridges.h"
#include "tests/support/made_up_database.h"
#include "tests/support/program.h"

namespace voussoir {
namespace {

using test::ProgramResult;

/// A folder in which the small bridge is built.
struct Site {
  test::TemporaryFolder folder;
  std::filesystem::path output = folder / "small.h5";
  std::vector<std::string> arguments = {test::example_bridge("small").string(), "-o", output.string(),
                                        "--format", "json"};

  ProgramResult build(const test::Program::Prepare& prepare = {}) const {
    return test::run("build-database", arguments, prepare);
  }
  ProgramResult build_with(std::vector<std::string> more) const {
    more.insert(more.begin(), arguments.begin(), arguments.end());
    return test::run("build-database", more);
  }
};

/// Digest of the small bridge's database, built once without any interruption.
std::string undisturbed_digest() {
  static const std::string digest = test::json_of(Site().build()).at("digest");
  return digest;
}

}  // namespace

TEST_CASE("build-database reports a whole build in one line of JSON and leaves only the database",
          "[whole-build]") {
  const Site site;
  const ProgramResult result = site.build();
  const auto json = test::json_of(result);
  CHECK(test::is_one_line(result.out));
  CHECK(json.at("ok") == true);
  CHECK(json.at("scenes") == 742);
  CHECK(json.at("standing").get<int>() + json.at("collapsed").get<int>() + json.at("unresolved").get<int>() ==
        742);
  CHECK(json.at("digest") == Database::open(site.output).digest());
  CHECK(std::distance(std::filesystem::directory_iterator(site.folder.path()), {}) == 1);
}

TEST_CASE("build-database says how many small pieces were joined to their neighbours (by hand)") {
  const Site site;
  write_file(site.folder / "wall.toml",
             "spans = []\n[wall]\nlength_m = 3.05\ncourses = 2\ncourse_height_m = 0.5\nblock_length_m = 1.0\n"
             "bond = \"stack\"\n[control_points]\narch = false\n");
  const auto build = [&](const std::string& format) {
    return test::run("build-database", {(site.folder / "wall.toml").string(), "-o", site.output.string(),
                                        "--scenes", "intact", "--format", format, "--force"});
  };
  CHECK(test::json_of(build("json")).at("joined_pieces") == 2);
  CHECK(build("text").out.find("joined      2 pieces") != std::string::npos);
}

TEST_CASE("build-database run again says that the file is up to date and ends with 0") {
  const Site site;
  test::json_of(site.build_with({"--scenes", "intact;5,1"}));
  const auto again = test::json_of(site.build_with({"--scenes", "5,1;intact"}));
  CHECK(again.at("up_to_date") == true);
  CHECK(again.at("computed") == 0);
}

TEST_CASE("Scenes and states that are still valid are not dropped unasked") {
  const test::TemporaryFolder folder;
  const std::string file = (folder / "small.h5").string();
  const auto build = [&](const std::string& scenes, const std::string& histories,
                         const std::string& more = "") {
    std::vector<std::string> arguments = {test::example_bridge("small").string(),
                                          "-o",
                                          file,
                                          "--scenes",
                                          scenes,
                                          "--history",
                                          histories,
                                          "--known-bridge",
                                          "--quiet"};
    if (!more.empty()) arguments.push_back(more);
    return test::run("build-database", arguments);
  };
  REQUIRE(build("intact;2,4;3,6", "built,lost").exit_code == 0);
  const ProgramResult fewer = build("intact;2,4", "built,lost");
  CHECK(fewer.exit_code == 1);
  CHECK_THAT(fewer.err, Catch::Matchers::Contains("small.h5: 1 of its 3 scenes would be lost") &&
                            Catch::Matchers::Contains("--drop"));
  const ProgramResult without = build("intact;2,4;3,6", "built");
  CHECK(without.exit_code == 1);
  CHECK_THAT(without.err, Catch::Matchers::Contains("3 of its 3 scenes as lost would be lost"));
  CHECK(build("intact;2,4;3,6;4,2", "built,lost").exit_code == 0);
  CHECK(build("intact", "built", "--drop").exit_code == 0);
}

TEST_CASE("Nothing that is no result of this build is replaced, whatever is forced") {
  const test::TemporaryFolder folder;
  const std::string bridge = (folder / "small.toml").string();
  std::filesystem::copy_file(test::example_bridge("small"), bridge);
  const auto build = [&](const std::string& output, std::vector<std::string> more) {
    more.insert(more.begin(), {bridge, "-o", output, "--known-bridge", "--quiet"});
    return test::run("build-database", more);
  };
  const auto refused = [&](const std::string& output, const std::vector<std::string>& more,
                           const std::string& words, int exit_code = 2) {
    const ProgramResult result = build(output, more);
    CHECK(result.exit_code == exit_code);
    CHECK_THAT(result.err, Catch::Contains(words));
  };
  const std::vector<std::string> intact = {"--scenes", "intact"};
  refused(bridge, {"--scenes", "intact", "--force"}, "is the bridge file, which would be lost");
  refused(folder.path().string(), {"--scenes", "intact", "--force"}, "is no file");
  refused("", {"--scenes", "intact", "--force"}, "'' given, expected the name of a file");
  const std::string whole = (folder / "whole.h5").string();
  REQUIRE(build(whole, {"--scenes", "intact;2,4;3,6"}).exit_code == 0);
  refused(whole, {"--scenes", "singles", "--shard", "1/4"}, "of its 3 scenes would be lost", 1);
  const std::string views = (folder / "other.views.h5").string();
  REQUIRE(build(views, intact).exit_code == 0);
  refused((folder / "other.h5").string(), {"--scenes", "intact", "--xdmf", "intact"},
          "other.views.h5 is there");
  CHECK(build(views, intact).exit_code == 0);
  std::filesystem::copy_file(whole, folder / "new.h5.partial");
  refused((folder / "new.h5").string(), intact, "new.h5.partial: is there and holds no scenes of a build", 1);
  const std::string points = (folder / "points.h5").string();
  REQUIRE(build(points, {"--scenes", "intact;2,4", "--fields", "none"}).exit_code == 0);
  refused(points, {"--scenes", "intact", "--fields", "none"}, "1 of its 2 scenes would be lost", 1);
}

TEST_CASE("Fields and sensitivities are not dropped unasked") {
  const test::TemporaryFolder folder;
  const auto build = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {test::example_bridge("small").string(), "-o", (folder / "small.h5").string(),
                               "--scenes", "intact", "--quiet"});
    return test::run("build-database", more);
  };
  REQUIRE(build({}).exit_code == 0);
  CHECK_THAT(build({"--fields", "none"}).err, Catch::Contains("all its fields would be lost"));
  CHECK_THAT(build({"--known-bridge"}).err, Catch::Contains("its sensitivities would be lost"));
  CHECK(build({"--known-bridge", "--drop"}).exit_code == 0);
}

TEST_CASE("Sampled bridges are not replaced by others of the same number unasked") {
  const test::TemporaryFolder folder;
  const auto build = [&](const std::string& seed) {
    return test::run("build-database",
                     {test::example_bridge("small").string(), "-o", (folder / "v.h5").string(), "--scenes",
                      "intact", "--variants", "1", "--variant-seed", seed, "--known-bridge", "--quiet"});
  };
  REQUIRE(build("1").exit_code == 0);
  const ProgramResult other = build("2");
  CHECK(other.exit_code == 1);
  CHECK_THAT(other.err, Catch::Contains("1 of its 2 scenes would be lost"));
}

TEST_CASE("The digest of real scenes is the same for 1, 2 and 5 threads", "[whole-build]") {
  for (const char* threads : {"1", "2", "5"})
    CHECK(test::json_of(Site().build_with({"--threads", threads})).at("digest") == undisturbed_digest());
}

TEST_CASE("A build killed at random moments at least 20 times ends with the digest of an undisturbed one",
          "[whole-build]") {
  const std::string expected = undisturbed_digest();
  const Site site;
  std::mt19937 random(20);
  std::size_t kills = 0;
  std::size_t resumed = 0;
  for (std::size_t finished = 0; kills < 20;) {
    REQUIRE(finished < 20);
    test::Program build("build-database", site.arguments);
    std::this_thread::sleep_for(std::chrono::milliseconds(5 + random() % 200));
    build.kill();
    const ProgramResult result = build.wait();
    if (result.signal == SIGKILL) ++kills;
    if (result.exit_code == 0) {  // it was quicker than the kill: that must be right, too; begin again
      ++finished;
      const auto json = nlohmann::json::parse(result.out);
      CHECK(json.at("digest") == expected);
      resumed += json.at("resumed").get<std::size_t>();
      std::filesystem::remove(site.output);
    }
  }
  const auto last = test::json_of(site.build());
  CHECK(last.at("digest") == expected);
  CHECK(resumed + last.at("resumed").get<std::size_t>() > 0);
  CHECK(test::run("verify-database", {site.output.string()}).exit_code == 0);
}

TEST_CASE("When the disk is full the build says so, keeps what is done and goes on later", "[whole-build]") {
  const Site site;
  const ProgramResult full = site.build(test::file_size_limit(500'000));
  CHECK(full.exit_code == 1);
  CHECK_THAT(full.err, Catch::Contains("small.h5.partial: cannot be written: File too large"));
  CHECK_THAT(full.err, Catch::Contains("run the same command again"));
  CHECK_FALSE(std::filesystem::exists(site.output));
  const auto json = test::json_of(site.build());
  CHECK(json.at("resumed") > 20);
  CHECK(json.at("digest") == undisturbed_digest());
}

TEST_CASE("When only the finished file does not fit on the disk every scene is kept", "[whole-build]") {
  const Site site;
  test::json_of(site.build());
  const std::uintmax_t size = std::filesystem::file_size(site.output);
  std::filesystem::remove(site.output);
  const ProgramResult full = site.build(test::file_size_limit(size - 1));
  CHECK(full.exit_code == 1);
  CHECK_THAT(full.err, Catch::Contains("cannot be written: File too large; all scenes are kept"));
  CHECK_FALSE(std::filesystem::exists(site.output));
  CHECK_FALSE(std::filesystem::exists(unfinished_path(site.output)));
  const auto json = test::json_of(site.build());
  CHECK(json.at("resumed") == 742);
  CHECK(json.at("computed") == 0);
  CHECK(json.at("digest") == undisturbed_digest());
}

TEST_CASE("A full disk leaves the old database as it was", "[whole-build]") {
  const Site site;
  test::json_of(site.build_with({"--scenes", "singles"}));
  const std::string before = Database::open(site.output).digest();
  CHECK(site.build(test::file_size_limit(500'000)).exit_code == 1);
  CHECK(Database::open(site.output).digest() == before);
}

TEST_CASE("In a folder that cannot be written to the build says so and ends with 1") {
  const Site site;
  std::filesystem::permissions(site.folder.path(), std::filesystem::perms(0555));
  const ProgramResult result = site.build(test::obey_permissions);
  std::filesystem::permissions(site.folder.path(), std::filesystem::perms(0755));
  CHECK(result.exit_code == 1);
  CHECK(test::is_one_line(result.err));
  CHECK_THAT(result.err, Catch::Contains("small.h5.partial: cannot be written: Permission denied"));
}

TEST_CASE("Of two builders of one file the second is told and the first is not disturbed", "[whole-build]") {
  const Site site;
  {
    const Journal held =
        Journal::open(site.output, test::made_up_provenance(test::small_bridge_file()), "key");
    const ProgramResult result = site.build();
    CHECK(result.exit_code == 1);
    CHECK_THAT(result.err, Catch::Contains("another build-database is working on this database"));
  }
  test::Program first("build-database", site.arguments);
  test::Program second("build-database", site.arguments);
  const ProgramResult one = first.wait();
  const ProgramResult other = second.wait();
  // Whoever comes second is told so, or comes when all is done.
  CHECK((one.exit_code == 0 || other.exit_code == 0));
  for (const ProgramResult* result : {&one, &other})
    if (result->exit_code != 0) {
      CHECK(result->exit_code == 1);
      CHECK_THAT(result->err, Catch::Contains("another build-database is working on this database"));
    }
  CHECK(Database::open(site.output).digest() == undisturbed_digest());
}

TEST_CASE("Bad usage of build-database is told in words and ends with 2") {
  const Site site;
  const auto refused = [&](std::vector<std::string> arguments, const std::string& words) {
    const ProgramResult result = site.build_with(std::move(arguments));
    CHECK(result.exit_code == 2);
    CHECK_THAT(result.err, Catch::Contains(words));
  };
  refused({"--solver", "magic"}, "magic not in {quasi-static,dynamic}");
  refused({"--format", "xml"}, "xml not in {text,json}");
  refused({"--threads", "many"}, "--threads");
  refused({"--threads", "-1"}, "--threads");
  refused({"--fields", "some"}, "some not in {all,none}");
  refused({"--scenes", "9,1"}, "no course 9");
  refused({"--scenes", "5,1..x"}, "cannot read '5,1..x'");
  refused({"--tolerance", "1"}, "--tolerance");
  refused({"--threads", "010"}, "'010' given, expected a decimal number");
  refused({"--threads", "0x2"}, "'0x2' given, expected a decimal number");
}

TEST_CASE("A bridge file that is missing or bad is named") {
  const test::TemporaryFolder folder;
  const ProgramResult missing = test::run("build-database", {(folder / "none.toml").string()});
  CHECK(missing.exit_code == 2);
  CHECK_THAT(missing.err, Catch::Contains("none.toml"));
  CHECK(test::is_one_line(missing.err));
  std::ofstream(folder / "bad.toml") << "[wall]\nlength_m = -20\n";
  const ProgramResult bad = test::run("build-database", {(folder / "bad.toml").string()});
  CHECK(bad.exit_code == 2);
  CHECK_THAT(bad.err, Catch::Contains("bad.toml:2"));
}

TEST_CASE("build-database --help and --version end with 0 and say what they should") {
  const ProgramResult help = test::run("build-database", {"--help"});
  CHECK(help.exit_code == 0);
  CHECK_THAT(help.out, Catch::Contains("--scenes") && Catch::Contains("Exit codes"));
  const ProgramResult version = test::run("build-database", {"--version"});
  CHECK(version.exit_code == 0);
  CHECK_THAT(version.out, Catch::Contains("compiler:") && Catch::Contains("solver revision:"));
}

TEST_CASE("build-database --version says just what the database that it would build states of its origin") {
  const Site site;
  test::json_of(site.build_with({"--scenes", "intact", "--solver", "dynamic"}));
  const Provenance stated = Database::open(site.output).provenance();
  const ProgramResult version = site.build_with({"--solver", "dynamic", "--version"});
  CHECK(version.exit_code == 0);
  CHECK_THAT(version.out, Catch::Contains(describe(stated)));
  CHECK_THAT(version.out, Catch::Contains("build-database " + stated.program_version) &&
                              Catch::Contains("compiler: " + stated.compiler) &&
                              Catch::Contains("flags: " + stated.compile_flags) &&
                              Catch::Contains("solver revision: " + stated.solver_revision) &&
                              Catch::Contains("results key: " + stated.results_key) &&
                              Catch::Contains("  name = \"small\"") &&
                              Catch::Contains(to_hexadecimal(sha256(stated.bridge_text))));
  const auto default_settings = test::run("build-database", {"--version"});
  CHECK_THAT(default_settings.out,
             Catch::Contains("bridge: reference") && !Catch::Contains(stated.results_key));
}

TEST_CASE("Progress is told in plain lines when stderr is no terminal and not at all when quiet") {
  const Site site;
  const ProgramResult told = site.build_with({"--scenes", "intact;5,1"});
  CHECK_THAT(told.err, Catch::Contains("0 of 2 scenes\n") && Catch::Contains("2 of 2 scenes"));
  CHECK(told.err.find('\r') == std::string::npos);
  CHECK(site.build_with({"--scenes", "intact;5,2", "--drop", "--quiet"}).err.empty());
}

}  // namespace voussoir
