/// @file Readings of a bridge that stands, though it would fall just as its file says. Oracle: the truth, a
/// bridge drawn at random (examples/bridges/small.toml, --variants 20, the ninth) that lost block 3,5, solved
/// by itself, with errors of 0.01 mm.

#include <catch2/catch.hpp>
#include <fstream>

#include "tests/support/answer.h"
#include "tests/support/bridges.h"
#include "tests/support/file_text.h"

using Catch::Matchers::Contains;
using nlohmann::json;
namespace test = voussoir::test;

namespace {

constexpr char kReadings[] =
    "point,change_mm,sigma_mm\n"
    "T1,0.019,0.01\nT2,0.007,0.01\nT3,0.009,0.01\nT4,-0.012,0.01\nT5,0.011,0.01\nT6,-0.066,0.01\n"
    "T7,-0.052,0.01\nT8,-0.290,0.01\nT9,-0.321,0.01\nT10,-0.489,0.01\nT11,-0.362,0.01\n"
    "T12,-0.109,0.01\nT13,-0.138,0.01\nT14,-0.117,0.01\nA1,0.000,0.01\nA2,0.012,0.01\n"
    "A3,0.004,0.01\nA4,0.006,0.01\nA5,-0.010,0.01\nA6,-0.032,0.01\nA7,-0.032,0.01\nA8,-0.042,0.01\n"
    "A9,-0.062,0.01\nA10,-0.093,0.01\nA11,-0.127,0.01\nA12,-0.223,0.01\nA13,-0.215,0.01\n"
    "A14,-0.291,0.01\nA15,-0.306,0.01\nA16,-0.294,0.01\nA17,-0.178,0.01\nA18,-0.116,0.01\n"
    "A19,-0.031,0.01\nA20,-0.025,0.01\nA21,-0.004,0.01\nA22,0.004,0.01\n";

class Workshop {
 public:
  Workshop() {
    const test::ProgramResult built =
        test::run("build-database", {test::example_bridge("small").string(), "-o", database(), "--scenes",
                                     "singles", "--history", "built,lost", "--fields", "none", "--quiet"});
    if (built.exit_code != 0) throw std::runtime_error(built.err);
    std::ofstream(readings()) << kReadings;
  }

  test::ProgramResult locate(std::vector<std::string> more) const {
    more.insert(more.begin(), {readings(), "-d", database()});
    return test::run("locate-damage", more);
  }
  std::string database() const { return (folder_ / "small.h5").string(); }
  std::string page() const { return (folder_ / "page.html").string(); }

 private:
  std::string readings() const { return (folder_ / "read.csv").string(); }
  test::TemporaryFolder folder_;
};

const Workshop& workshop() {
  static const Workshop shared;
  return shared;
}

}  // namespace

TEST_CASE("A loss after which the file's bridge would fall is named, and the answer says so",
          "[whole-build]") {
  const json answer = test::json_of(workshop().locate({"--format", "json"}));
  CHECK(answer.at("verdict") == "located");
  const json& first = answer.at("candidates").at(0);
  CHECK(first.at("scene") == "3,5");
  CHECK(first.at("outcome") == "collapsed");
  CHECK(first.at("standing_share").get<double>() > 0.1);
  CHECK(first.at("standing_share").get<double>() < 1.0);
  CHECK(answer.at("candidates").at(1).at("standing_share").is_null());
  const test::ProgramResult text = workshop().locate({"--report", workshop().page()});
  CHECK_THAT(text.out, Contains("Block 3,5 is missing") &&
                           Contains("just as the file says would not stand without 3,5"));
  CHECK_THAT(test::text_of(workshop().page()), Contains("may stand"));
}

TEST_CASE("To a bridge that is said to be just as its file says such a loss does not happen",
          "[whole-build]") {
  const json answer = test::json_of(workshop().locate({"--known-bridge", "--format", "json", "--top", "40"}));
  for (const json& candidate : answer.at("candidates")) CHECK(candidate.at("scene") != "3,5");
}

TEST_CASE("Sensors can be planned for a loss that the bridge may survive, and its database is sound",
          "[whole-build]") {
  const test::ProgramResult planned =
      test::run("plan-sensors", {"-d", workshop().database(), "--sigma", "0.01mm", "--format", "csv"});
  CHECK(planned.exit_code == 0);
  CHECK_THAT(planned.out, Contains("\"3,5\",may,"));
  CHECK(test::run("verify-database", {workshop().database()}).exit_code == 0);
}
