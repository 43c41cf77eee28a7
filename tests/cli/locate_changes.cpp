/// Readings as they are taken, from make-measurements to locate-damage, on the small bridge (a known bridge:
/// the readings come from the database itself).

#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/answer.h"
#include "tests/support/bridges.h"
#include "tests/support/program.h"

using Catch::Matchers::Contains;
using voussoir::test::ProgramResult;
namespace test = voussoir::test;

namespace {

/// A folder with the small bridge's database (built once), without pairs.
struct Workshop {
  test::TemporaryFolder folder;
  std::string database = (folder / "small.h5").string();

  Workshop() {
    const ProgramResult built =
        test::run("build-database", {test::example_bridge("small").string(), "-o", database, "--scenes",
                                     "singles", "--quiet", "--known-bridge"});
    if (built.exit_code != 0) throw std::runtime_error(built.err);
  }
  std::string file(const std::string& name, const std::string& text) const {
    std::ofstream(folder / name, std::ios::binary) << text;
    return (folder / name).string();
  }
  std::string make(const std::string& scene, std::vector<std::string> more) const {
    const std::string path = (folder / "made.csv").string();
    more.insert(more.begin(), {scene, "-d", database, "-o", path});
    const ProgramResult made = test::run("make-measurements", more);
    INFO(made.err);
    REQUIRE(made.exit_code == 0);
    return path;
  }
  nlohmann::json locate(const std::string& path, std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {path, "-d", database, "--format", "json"});
    const ProgramResult result = test::run("locate-damage", more);
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    return nlohmann::json::parse(result.out);
  }
  std::string error(const std::string& readings, std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {file("bad.csv", readings), "-d", database});
    const ProgramResult result = test::run("locate-damage", more);
    CHECK(result.exit_code == 2);
    CHECK(result.out.empty());
    CHECK(test::is_one_line(result.err));
    return result.err;
  }
};

const Workshop& workshop() {
  static const Workshop shared;
  return shared;
}

const char* const kSensors =
    "name;quantity;x_m;y_m;x2_m;y2_m;block\nL;ux;0,75;0,75;;;\nR;tilt;;;;;4,2\nG;distance;0,8;0,8;0,8;1,2;\n";

}  // namespace

TEST_CASE("Changes, two epochs and other sensors name the scene that they were made from") {
  const std::string sensors = workshop().file("sensors.csv", kSensors);
  const std::vector<std::vector<std::string>> kinds = {{"--kind", "change"},
                                                       {"--kind", "epochs"},
                                                       {"--kind", "absolute"},
                                                       {"--kind", "change", "--sensors", sensors}};
  for (const char* const scene : {"intact", "4,2", "5,3"})
    for (const std::vector<std::string>& kind : kinds) {
      std::vector<std::string> how = kind;
      how.insert(how.end(), {"--sigma", "0.0001mm"});
      const auto json = workshop().locate(workshop().make(scene, how), {"--sensors", sensors});
      INFO(scene << " " << kind[1]);
      CHECK(json.at("candidates").at(0).at("scene") == scene);
      CHECK(json.at("verdict") == (std::string(scene) == "intact" ? "intact" : "located"));
      CHECK(json.at("history") == "built");
    }
}

TEST_CASE("The same seed gives the same change as a change and as two epochs") {
  const auto readings = [](const char* kind) {
    const auto json =
        workshop().locate(workshop().make("4,2", {"--kind", kind, "--sigma", "0.02", "--seed", "7"}));
    std::vector<double> changes;
    for (const auto& sensor : json.at("sensors")) changes.push_back(sensor.at("reading_m").get<double>());
    return changes;
  };
  const std::vector<double> change = readings("change"), epochs = readings("epochs");
  REQUIRE(change.size() == epochs.size());
  // Files have nanometres: half of one in the change, and in each of the two epochs.
  for (std::size_t i = 0; i < change.size(); ++i) CHECK(change[i] == Approx(epochs[i]).margin(1.6e-9));
}

TEST_CASE("A file reads the same with semicolons and decimal commas") {
  const std::string comma =
      "point,before_mm,after_mm,sigma_mm\nT1,1.5,1.25,0.01\nT4,0.5,0.75,0.01\nA3,1,1,0.01\n";
  const std::string semicolon =
      "\xEF\xBB\xBFPoint;Before_mm;After_mm;Sigma_mm\r\nT1;1,5;1,25;0,01\r\nT4;0,5;0,75;0,01\r\nA3;1;1;0,"
      "01\r\n";
  const auto of = [&](const std::string& text) {
    return workshop().locate(workshop().file("read.csv", text));
  };
  CHECK(of(comma) == of(semicolon));
}

TEST_CASE("A datum of the second epoch is no damage when it is said to be unknown") {
  const std::string path =
      workshop().make("intact", {"--kind", "change", "--sigma", "0.0001mm", "--datum", "0.5mm"});
  CHECK(workshop().locate(path, {"--unknown-datum", "0.5"}).at("candidates").at(0).at("scene") == "intact");
}

TEST_CASE("Changes without any error are refused, as where nothing has changed no share of it is one") {
  const std::string one = "point,change_mm\nT1,-0.02\n";
  CHECK_THAT(workshop().error(one), Contains("a change without an error (at ") && Contains("sigma_mm"));
  const std::string path = workshop().file("one.csv", one);
  CHECK(workshop().locate(path, {"--floor", "0.02"}).at("verdict") != "damaged-unlocated");
  CHECK(workshop().locate(path, {"--sigma", "0.02mm"}).at("verdict") != "damaged-unlocated");
}

TEST_CASE("What --missing leaves no choice of is no verdict") {
  const std::string path = workshop().make("intact", {"--kind", "change", "--sigma", "0.02mm"});
  CHECK(workshop().locate(path, {"--missing", "1"}).at("verdict") == "cannot-tell");
  CHECK(workshop().locate(path, {"--missing", "0"}).at("verdict") == "cannot-tell");
  CHECK(workshop().locate(path).at("verdict") == "intact");
}

TEST_CASE("Outputs do not take the place of inputs or databases, and say what they are") {
  const auto refusal = [](const std::string& program, const std::vector<std::string>& arguments) {
    const ProgramResult result = test::run(program, arguments);
    CHECK(result.exit_code == 2);
    return result.err;
  };
  const Workshop& shop = workshop();
  const std::string path = shop.make("intact", {"--kind", "change", "--sigma", "0.02mm"});
  CHECK_THAT(refusal("make-measurements", {"intact", "-d", shop.database, "-o", shop.database}),
             Contains("is a database"));
  CHECK_THAT(refusal("locate-damage", {path, "-d", shop.database, "--report", shop.database}),
             Contains("expected a file that ends in .html or .htm or .svg"));
  const std::string page = shop.file("page.html", "point,change_mm,sigma_mm\nT1,0,0.02\n");
  CHECK_THAT(refusal("locate-damage", {page, "-d", shop.database, "--report", page}),
             Contains("is read by this very command"));
  const std::string sensors = shop.file("own.csv", "name,quantity,x_m,y_m\nS,uy,2.9,2.4\n");
  CHECK_THAT(refusal("make-measurements", {"intact", "-d", shop.database, "--kind", "change", "--sigma",
                                           "0.02mm", "--sensors", sensors, "-o", sensors}),
             Contains("is read by this very command"));
}

TEST_CASE("What has no effect on an answer is said (written out)") {
  const Workshop& shop = workshop();
  const std::string file =
      shop.file("own-errors.csv", "point,change_mm,sigma_mm,levelling\nT1,0,0.02,a\nA1,0,0.02,b\n");
  const auto answer = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {file, "-d", shop.database};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return test::run("locate-damage", arguments).out;
  };
  CHECK_THAT(answer({}), !Contains("--sigma has no effect") && Contains("levellings are named"));
  CHECK_THAT(answer({"--sigma", "0.5mm"}), Contains("--sigma has no effect"));
  CHECK_THAT(answer({"--noise", "5%"}), Contains("--noise has no effect"));
  CHECK_THAT(answer({"--unknown-datum", "0.3mm"}), !Contains("levellings are named"));
}

TEST_CASE("Wrong questions about readings give one line with what was expected") {
  const std::string change = "point,change_mm\nT1,1\n";
  CHECK_THAT(workshop().error("point,before_mm\nT1,1\n"),
             Contains(":1:") && Contains("values before without values after"));
  CHECK_THAT(workshop().error("point,load,uy_mm\nT1,axle,1\n"),
             Contains(":2:") && Contains("no load 'axle'"));
  CHECK_THAT(workshop().error(change, {"--history", "lost"}), Contains("has no history 'lost'"));
  CHECK_THAT(workshop().error(change, {"--history", "broken"}), Contains("--history"));
  for (const char* const sigma : {"0", "-1", "0.02m", "nan"})
    CHECK_THAT(workshop().error(change, {"--sigma", sigma}),
               Contains("expected millimetres from 5e-05 to 10000"));
  const std::string outside = workshop().file("outside.csv", "name,quantity,x_m,y_m\nV,uy,50,1\n");
  CHECK_THAT(workshop().error(change, {"--sensors", outside}),
             Contains("outside.csv:2:") && Contains("outside the bridge"));
  CHECK_THAT(workshop().error("point;uy_mm\nT1;1.234\n"), Contains(":2:") && Contains("1.234 or 1234"));
}

TEST_CASE("make-measurements refuses what cannot be simulated") {
  const auto code = [](std::vector<std::string> more) {
    more.insert(more.begin(), {"4,2", "-d", workshop().database});
    const ProgramResult result = test::run("make-measurements", more);
    CHECK(result.out.empty());
    CHECK(test::is_one_line(result.err));
    return result.exit_code;
  };
  CHECK(code({"--noise-model", "auto"}) == 2);
  CHECK(code({"--sigma", "0"}) == 2);
  CHECK(code({"--sigma", "0.02", "--noise", "5%"}) == 2);
  CHECK(code({"--kind", "change", "--load", "axle"}) == 2);
  CHECK(code({"--load", "axle"}) == 2);
  CHECK(code({"--load", ""}) == 2);
  CHECK(code({"--load", "axle,axle"}) == 2);
  CHECK(code({"--seed", "-1"}) == 2);
}

TEST_CASE("Readings are written as finely as their errors ask for, so that bounded ones keep their bound") {
  for (const char* const seed : {"11", "12", "13"}) {
    const std::string path = workshop().make("4,2", {"--noise", "0.1%", "--seed", seed});
    const auto json =
        workshop().locate(path, {"--noise", "0.1%", "--noise-model", "uniform", "--model-error", "0"});
    CHECK(json.at("verdict") == "located");
  }
}
