#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/support/bridges.h"
#include "tests/support/program.h"

namespace voussoir {
namespace {

using test::ProgramResult;

std::filesystem::path build_small(const test::TemporaryFolder& folder,
                                  const std::vector<std::string>& more = {}) {
  const std::filesystem::path output = folder / "small.h5";
  std::vector<std::string> arguments = {
      test::example_bridge("small").string(), "-o", output.string(), "--scenes", "singles", "--quiet"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  REQUIRE(test::run("build-database", arguments).exit_code == 0);
  return output;
}

}  // namespace

TEST_CASE("verify-database finds nothing wrong with a fresh database and scenes solved anew are the same") {
  for (const std::vector<std::string>& more : std::vector<std::vector<std::string>>{
           {},
           {"--fields", "none"},
           {"--without", "mirror-images,warm-starts"},
           {"--solver", "dynamic"},
           {"--solver", "dynamic", "--ramp", "0.2", "--damping", "30.5", "--step", "2e-4"}}) {
    const test::TemporaryFolder folder;
    const auto path = build_small(folder, more);
    const ProgramResult result =
        test::run("verify-database", {path.string(), "--recompute", "10", "--format", "json"});
    INFO(result.out << result.err);
    CHECK(result.exit_code == 0);
    const auto json = nlohmann::json::parse(result.out);
    CHECK(json.at("ok") == true);
    CHECK(json.at("scenes") == 39);
    CHECK(json.at("standing").get<int>() + json.at("collapsed").get<int>() +
              json.at("unresolved").get<int>() ==
          39);
    CHECK(json.at("recomputed") == 10);
    CHECK(json.at("largest_recomputed_difference_m") == 0.0);
    CHECK(json.at("digest").get<std::string>().size() == 64);
    CHECK(json.at("problems").empty());
  }
}

TEST_CASE("verify-database names what is wrong and ends with 1") {
  const test::TemporaryFolder folder;
  const auto path = build_small(folder, {"--known-bridge"});
  std::fstream stream(path, std::ios::in | std::ios::out | std::ios::binary);
  const auto middle = static_cast<std::streamoff>(std::filesystem::file_size(path) / 2);  // amid the fields
  stream.seekg(middle);
  const char byte = static_cast<char>(stream.get() ^ 16);
  stream.seekp(middle);
  stream.put(byte);
  stream.close();
  const ProgramResult result = test::run("verify-database", {path.string(), "--format", "json"});
  CHECK(result.exit_code == 1);
  const auto json = nlohmann::json::parse(result.out);
  CHECK(json.at("ok") == false);
  REQUIRE_FALSE(json.at("problems").empty());
  // The mirror image's check comes upon the damaged field, too, and may come first.
  std::string problem;
  for (const std::string each : json.at("problems"))
    if (each.find("the stored bytes of its field") != std::string::npos) problem = each;
  CHECK_THAT(problem, Catch::Matches("scene [0-9]+,[0-9]+: the stored bytes of its field .*"));
  const ProgramResult text = test::run("verify-database", {path.string()});
  CHECK(text.exit_code == 1);
  CHECK_THAT(text.out, Catch::Contains("NOT in order") && Catch::Contains(problem));
}

TEST_CASE("verify-database reports a file cut short as a problem and a missing one on stderr") {
  const test::TemporaryFolder folder;
  const auto path = build_small(folder);
  std::filesystem::resize_file(path, 10'000);
  const ProgramResult cut = test::run("verify-database", {path.string(), "--format", "json"});
  CHECK(cut.exit_code == 1);
  CHECK_THAT(nlohmann::json::parse(cut.out).at("problems")[0].get<std::string>(),
             Catch::Contains("damaged or incomplete"));
  const ProgramResult missing = test::run("verify-database", {(folder / "none.h5").string()});
  CHECK(missing.exit_code == 1);
  CHECK_THAT(missing.err, Catch::Contains("none.h5: cannot be read"));
  CHECK(test::run("verify-database", {}).exit_code == 2);
  CHECK(test::run("verify-database", {path.string(), "--recompute", "-3"}).exit_code == 2);
}

}  // namespace voussoir
