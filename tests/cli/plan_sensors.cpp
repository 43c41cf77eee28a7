/// @file plan-sensors as a user runs it, on the small bridge. Oracles: the options' own meaning, the
/// database's outcomes, answers of locate-damage.

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "tests/support/bridges.h"
#include "tests/support/file_text.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

namespace voussoir {
namespace {

using nlohmann::json;

struct Planned {
  test::TemporaryFolder folder;
  std::string database = build("small", {});
  std::string known = build("known", {"--known-bridge"});

  std::string build(const std::string& name, std::vector<std::string> more) const {
    const std::string file = (folder / (name + ".h5")).string();
    more.insert(more.begin(), {test::example_bridge("small"), "-o", file, "--scenes", "singles", "--history",
                               "built,lost", "--quiet"});
    REQUIRE(test::run("build-database", more).exit_code == 0);
    return file;
  }
  test::ProgramResult plan(std::vector<std::string> more) const {
    more.insert(more.begin(), {"-d", database});
    return test::run("plan-sensors", more);
  }
  json plan_json(std::vector<std::string> more) const {
    more.insert(more.end(), {"--format", "json"});
    const test::ProgramResult result = plan(more);
    REQUIRE(result.exit_code == 0);
    return json::parse(result.out);
  }
};

const Planned& planned() {
  static const Planned made;
  return made;
}

}  // namespace

TEST_CASE("plan-sensors has every block once, and falls are those of the database (query-field)") {
  const json plan = planned().plan_json({"--sigma", "0.01mm"});
  std::set<std::string> blocks;
  std::size_t seen = 0, named = 0, falls = 0;
  double sum = 0.0;
  for (const json& block : plan["blocks"]) {
    blocks.insert(block["block"]);
    const test::ProgramResult field = test::run(
        "query-field", {block["block"], "-d", planned().database, "--history", "lost", "--at", "control"});
    CHECK((block["falls"] == "no") == (field.exit_code == 0 && field.err.empty()));
    falls += block["falls"] == "yes" ? 1 : 0;
    if (block["falls"] == "yes") continue;
    seen += block["seen"] >= 0.9 ? 1 : 0;
    named += block["named"] >= 0.9 ? 1 : 0;
    CHECK(block["named"] <= block["seen"]);
    sum += block["seen"].get<double>();
  }
  CHECK(plan["mean_seen"] == Approx(sum / static_cast<double>(blocks.size() - falls)));
  CHECK(blocks.size() == plan["blocks"].size());
  CHECK(plan["seen"] == seen);
  CHECK(plan["named"] == named);
  CHECK(plan["falls"] == falls);
  CHECK(falls > 0);
}

TEST_CASE("What a plan says to be named for certain, or never seen, answers say, too (locate-damage)") {
  const auto [sigma, conditions] = GENERATE(std::pair("0.001mm", "known"), std::pair("0.03mm", "uncertain"));
  int certain = 0, never = 0;
  const json plan = planned().plan_json({"--sigma", sigma, "--conditions", conditions});
  for (const json& block : plan["blocks"]) {
    if (block["falls"] != "no") continue;
    const bool named = block["named"] >= 0.98;
    if (!named && block["seen"] > 0.0) continue;
    const std::string readings = (planned().folder / "change.csv").string();
    REQUIRE(test::run("make-measurements", {block["block"], "-d", planned().database, "--kind", "change",
                                            "--sigma", sigma, "-o", readings})
                .exit_code == 0);
    const json answer =
        json::parse(test::run("locate-damage", {readings, "-d", planned().database, "--conditions",
                                                conditions, "--format", "json"})
                        .out);
    CHECK((answer["verdict"] == "located" && answer["candidates"][0]["scene"] == block["block"]) == named);
    (named ? certain : never) += 1;
  }
  CHECK(certain + never >= 3);
}

TEST_CASE("plan-sensors chooses so many sensors of those that it may, and draws them") {
  const std::string picture = (planned().folder / "plan.svg").string();
  const json plan = planned().plan_json(
      {"--sigma", "0.01mm", "--points", "T1,T3,A2,A4,A5", "--choose", "3", "--report", picture});
  CHECK(plan["chosen"].size() == 3);
  CHECK(plan["points"].size() == 3);
  const std::set<std::string> allowed = {"T1", "T3", "A2", "A4", "A5"};
  const std::string drawn = test::text_of(picture);
  for (const json& point : plan["chosen"]) {
    CHECK(allowed.contains(point));
    CHECK(drawn.find("<title>" + point.get<std::string>() + "</title>") != std::string::npos);
  }
  CHECK(planned().plan_json({"--sigma", "0.01mm", "--points", "T1"})["points"] == json{"T1"});
  const json all = planned().plan_json({"--sigma", "0.01mm"});
  CHECK(all["chosen"].empty());
  CHECK(all["seen"] >= plan["seen"]);
  CHECK(planned().plan({"--sigma", "0.01mm"}).out.find("In trials:") != std::string::npos);
}

TEST_CASE(
    "A plan's text says in sentences how many losses would be seen, and names no block where none is seen") {
  const test::ProgramResult text = planned().plan({"--sigma", "1mm"});  // changes are far smaller
  CHECK_THAT(text.out,
             Catch::Contains("losses would be seen with a chance of 90 % or more; the average chance is") &&
                 Catch::Contains("none of ") && Catch::Contains("standard deviations of 1 mm"));
  const std::string table = text.out.substr(text.out.find("looks most like"));
  std::istringstream lines(table.substr(table.find('\n') + 1));
  int rows = 0;
  for (std::string line; std::getline(lines, line); ++rows) CHECK_THAT(line, Catch::EndsWith("no loss"));
  CHECK(rows == 15);
}

TEST_CASE("The names of planned sensors neither cover each other nor stick out (boxes of their letters)") {
  const std::string picture = (planned().folder / "names.svg").string();
  planned().plan({"--sigma", "0.01mm", "--report", picture});
  const std::string drawn = test::text_of(picture);
  const std::regex text(
      "<text x=\"([-0-9.]+)\" y=\"([-0-9.]+)\" text-anchor=\"middle\" class=\"label\">([^<]*)<");
  struct Name {
    double left, right, base;
  };
  std::vector<Name> names;
  for (std::sregex_iterator at(drawn.begin(), drawn.end(), text), none; at != none; ++at) {
    const double half = 3.3 * static_cast<double>((*at)[3].length());
    const double x = std::stod((*at)[1]);
    names.push_back({x - half, x + half, std::stod((*at)[2])});
  }
  CHECK(names.size() >= 10);
  for (std::size_t i = 0; i < names.size(); ++i) {
    CHECK((names[i].left >= 0.0 && names[i].right <= 1040.0));
    for (std::size_t k = 0; k < i; ++k)
      CHECK((names[i].left > names[k].right || names[k].left > names[i].right ||
             std::abs(names[i].base - names[k].base) > 11.0));
  }
}

TEST_CASE("plan-sensors refuses what it cannot plan, and says why") {
  const auto refusal = [](std::vector<std::string> arguments) {
    const test::ProgramResult result = test::run("plan-sensors", arguments);
    CHECK(result.out.empty());
    return std::pair(result.exit_code, result.err);
  };
  const auto contains = [](const std::pair<int, std::string>& refused, int code, const std::string& text) {
    CHECK(refused.first == code);
    CHECK(refused.second.find(text) != std::string::npos);
  };
  const std::string& database = planned().database;
  contains(refusal({"-d", database}), 2, "--sigma");
  contains(refusal({"-d", database, "--sigma", "0.01mm", "--points", "T1,X7"}), 2, "unknown point X7");
  contains(refusal({"-d", database, "--sigma", "0.01mm", "--points", "T1,T1"}), 2, "T1 comes twice");
  contains(refusal({"-d", database, "--sigma", "0.01mm", "--choose", "0"}), 2, "--choose");
  contains(refusal({"-d", database, "--sigma", "0.01mm", "--choose", "3", "--points", "T1,T2"}), 2,
           "at most the 2");
  contains(refusal({"-d", database, "--sigma", "5m"}), 2, "--sigma");
  contains(refusal({"-d", planned().known, "--sigma", "0.01mm"}), 1, "built without --known-bridge");
}

}  // namespace voussoir
