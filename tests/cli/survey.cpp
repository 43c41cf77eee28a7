/// @file Many files of readings in one call. Oracle: the answers to each file alone.

#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>
#include <tuple>

#include "tests/support/bridges.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

namespace voussoir {
namespace {

/// The small bridge's database, readings of three scenes and a file that is none.
struct Survey {
  test::TemporaryFolder folder;
  std::string database = (folder / "small.h5").string();
  std::vector<std::string> files;

  Survey() {
    REQUIRE(test::run("build-database", {test::example_bridge("small").string(), "-o", database, "--scenes",
                                         "singles", "--quiet"})
                .exit_code == 0);
    for (const std::string scene : {"4,2", "3,1", "intact"}) {
      files.push_back((folder / (scene + ".csv")).string());
      REQUIRE(test::run("make-measurements",
                        {scene, "-d", database, "--kind", "change", "--sigma", "0.01mm", "-o", files.back()})
                  .exit_code == 0);
    }
  }
  test::ProgramResult locate(const std::vector<std::string>& readings, const std::string& format) const {
    std::vector<std::string> arguments = readings;
    for (const std::string& word : {std::string("-d"), database, std::string("--format"), format})
      arguments.push_back(word);
    return test::run("locate-damage", arguments);
  }
};

}  // namespace

TEST_CASE("A survey says of every file what a call of its own says") {
  const Survey survey;
  const auto rows = nlohmann::json::parse(survey.locate(survey.files, "json").out);
  REQUIRE(rows.size() == survey.files.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto alone = nlohmann::json::parse(survey.locate({survey.files[i]}, "json").out);
    const auto& first = alone["candidates"][0];
    CHECK(rows[i]["file"] == survey.files[i]);
    CHECK(rows[i]["verdict"] == alone["verdict"]);
    CHECK(rows[i]["scene"] == first["scene"]);
    nlohmann::json named = "", certainty;  // no scene of the survey lacks more than one block
    for (const auto& block : alone["posterior"]["blocks"])
      if (alone["verdict"] == "located" && block["probability"] >= 0.9)
        std::tie(named, certainty) = std::pair(block["block"], block["probability"]);
    CHECK(rows[i]["named"] == named);
    CHECK(rows[i]["certainty"] == certainty);
    CHECK(rows[i]["posterior"] == first["posterior"]);
    CHECK(rows[i]["misfit"] == first["misfit"]);
    CHECK(rows[i]["intact_probability"] == alone["intact_probability"]);
    CHECK(rows[i]["error"] == "");
  }
}

TEST_CASE("A file that is none has a row of a survey that says why, and the others are answered") {
  Survey survey;
  const std::string bad = (survey.folder / "bad.csv").string();
  std::ofstream(bad) << "point,change_mm\nT1,high\n";
  survey.files.insert(survey.files.begin() + 1, {bad, (survey.folder / "absent.csv").string()});
  const test::ProgramResult csv = survey.locate(survey.files, "csv");
  CHECK(csv.exit_code == 1);
  CHECK_THAT(csv.err, Catch::Contains("2 of 5 files"));
  CHECK_THAT(csv.out,
             Catch::StartsWith("file,verdict,named,certainty,scene,posterior,intact_probability,misfit,"
                               "readings,reason,error,suspects,verdict_without,named_without,"
                               "open_losses,open_losses_without\n"));
  CHECK(std::ranges::count(csv.out, '\n') == 6);
  CHECK_THAT(csv.out, Catch::Contains("bad.csv:2") && Catch::Contains("absent.csv"));
  const test::ProgramResult text = survey.locate(survey.files, "text");
  CHECK_THAT(text.out, Catch::Contains("no answer: ") && Catch::Contains("first 4,2"));
  survey.files.push_back("--report");
  survey.files.push_back("page.html");
  CHECK(survey.locate(survey.files, "text").exit_code == 2);
}

}  // namespace voussoir
