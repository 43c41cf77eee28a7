/// @file A bridge whose file has sensors, from the build to the answer. Oracles: the same sensors read from
/// fields by --sensors; a sensor at a control point's place.

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

using nlohmann::json;

constexpr char kTable[] =
    "name,quantity,x_m,y_m,x2_m,y2_m,block\nH1,ux,0.75,1.8,,,\nN1,tilt,,,,,\"4,2\"\n"
    "G1,distance,0.25,0.75,0.25,1.25,\n";

struct Sensed {
  test::TemporaryFolder folder;
  std::string plain = build("plain", ""), sensed = build("sensed", test::kSmallSensors);

  std::string build(const std::string& name, const std::string& sensors) const {
    const std::string file = path(name + ".toml"), database = path(name + ".h5");
    std::ofstream(file) << test::text_of(test::example_bridge("small")) + sensors;
    const auto built =
        test::run("build-database", {file, "-o", database, "--history", "built,lost", "--quiet"});
    INFO(built.err);
    REQUIRE(built.exit_code == 0);
    return database;
  }
  std::string path(const std::string& name) const { return (folder / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name)) << text;
    return path(name);
  }
  json locate(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--format", "json"});
    const auto result = test::run("locate-damage", arguments);
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    return json::parse(result.out);
  }
  /// Changes of the database without a block, read with errors, but for these points.
  std::string readings(const std::string& scene, const std::string& name,
                       const std::vector<std::string>& without) const {
    const auto made = test::run(
        "make-measurements", {scene, "-d", sensed, "--kind", "change", "--sigma", "0.005mm", "--seed", "3"});
    REQUIRE(made.exit_code == 0);
    std::string kept;
    std::istringstream lines(made.out);
    for (std::string line; std::getline(lines, line);)
      if (std::ranges::none_of(without,
                               [&](const std::string& point) { return line.starts_with(point + ","); }))
        kept += line + "\n";
    return write(name, kept);
  }
};

const Sensed& sensed() {
  static const Sensed made;
  return made;
}

void check_same(const json& one, const json& other) {
  REQUIRE(one["candidates"].size() == other["candidates"].size());
  for (std::size_t i = 0; i < one["candidates"].size(); ++i) {
    CHECK(one["candidates"][i]["scene"] == other["candidates"][i]["scene"]);
    const char* const number = one["candidates"][i]["posterior"].is_null() ? "misfit" : "posterior";
    CHECK(one["candidates"][i][number].get<double>() ==
          Approx(other["candidates"][i][number].get<double>()).epsilon(1e-6).margin(1e-12));
  }
}

}  // namespace

TEST_CASE("A known bridge's sensors are read from the table as from the fields (--sensors)") {
  const std::string readings = sensed().readings("4,2", "known.csv", {"V1"});
  const std::string table = sensed().write("table.csv", kTable);
  for (const std::string objective : {"posterior", "paper"}) {
    const std::vector<std::string> common = {readings, "--known-bridge", "--model-error",
                                             "0",      "--objective",    objective};
    std::vector<std::string> stored = common, from_fields = common;
    stored.insert(stored.end(), {"-d", sensed().sensed});
    from_fields.insert(from_fields.end(), {"-d", sensed().plain, "--sensors", table});
    check_same(sensed().locate(stored), sensed().locate(from_fields));
  }
}

TEST_CASE(
    "A bridge that is not known is asked about any sensor of its file; at a control point's place one "
    "reads the same") {
  const std::string point = sensed().readings("3,6", "point.csv", {"V1"});
  std::string text = test::text_of(point);
  const auto at = text.find("\nT5,");
  REQUIRE(at != std::string::npos);
  text.replace(at, 4, "\nV1,");  // T5 is the same corner
  const json by_point = sensed().locate({point, "-d", sensed().sensed});
  const json by_sensor = sensed().locate({sensed().write("sensor.csv", text), "-d", sensed().sensed});
  check_same(by_point, by_sensor);
  CHECK(by_point["known_bridge"] == false);
  CHECK(by_point["verdict"] == by_sensor["verdict"]);
}

TEST_CASE("Databases without the sensors say how they come in") {
  const std::string readings = sensed().readings("4,2", "refused.csv", {"V1"});
  const std::string table = sensed().write("refused-table.csv", kTable);
  const auto refused = test::run("locate-damage", {readings, "-d", sensed().plain, "--sensors", table});
  CHECK(refused.exit_code == 2);
  CHECK_THAT(refused.err, Catch::Contains("[[sensors]] in the bridge file"));
}

TEST_CASE("A plan's errors may differ by what is read (the same as errors of all, where one is read)") {
  const auto plan = [](std::vector<std::string> options) {
    options.insert(options.end(), {"-d", sensed().sensed, "--format", "json"});
    const auto result = test::run("plan-sensors", options);
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    return json::parse(result.out)["blocks"];
  };
  const json small = plan({"--sigma", "0.01mm"}), large = plan({"--sigma", "0.5mm"});
  CHECK(small != large);
  CHECK(plan({"--sigma", "0.5mm", "--sigma-of", "uy=0.01mm,ux=0.01mm,tilt=0.01mm,distance=0.01mm"}) == small);
  const json mixed = plan({"--sigma", "0.5mm", "--sigma-of", "tilt=0.01", "--sigma-of", "ux=0.01mm"});
  CHECK(mixed != small);
  CHECK(mixed != large);
  CHECK(plan({"--sigma", "0.5mm", "--sigma-of", "tilt=0.01mm", "--points", "N1"}) ==
        plan({"--sigma", "0.01mm", "--points", "N1"}));
  const auto refused =
      test::run("plan-sensors", {"-d", sensed().sensed, "--sigma", "1mm", "--sigma-of", "angle=0.01"});
  CHECK(refused.exit_code == 2);
  CHECK_THAT(refused.err, Catch::Contains("expected ux, uy, tilt or distance"));
}

TEST_CASE("verify-database solves sensed scenes anew, query-field and plan-sensors know the sensors") {
  const auto verified = test::run("verify-database", {sensed().sensed, "--recompute", "10"});
  INFO(verified.out << verified.err);
  CHECK(verified.exit_code == 0);
  const auto field = test::run("query-field", {"4,2", "-d", sensed().sensed, "--at", "T5,V1,H1"});
  CHECK(field.exit_code == 0);
  const auto tilt = test::run("query-field", {"4,2", "-d", sensed().sensed, "--at", "N1"});
  CHECK(tilt.exit_code == 2);
  CHECK_THAT(tilt.err, Catch::Contains("reads a tilt"));
  const auto plan = test::run("plan-sensors", {"-d", sensed().sensed, "--sigma", "0.01mm", "--points",
                                               "N1,G1,H1", "--format", "json"});
  INFO(plan.err);
  REQUIRE(plan.exit_code == 0);
}

TEST_CASE("A sensor's answer does not change when its database is cut into shards and merged") {
  const std::string bridge = sensed().path("sensed.toml");
  std::vector<std::string> parts;
  for (const std::string part : {"1/2", "2/2"}) {
    parts.push_back(sensed().path("part" + part.substr(0, 1) + ".h5"));
    REQUIRE(test::run("build-database",
                      {bridge, "-o", parts.back(), "--history", "built,lost", "--quiet", "--shard", part})
                .exit_code == 0);
  }
  parts.insert(parts.end(), {"-o", sensed().path("merged.h5"), "--quiet"});
  REQUIRE(test::run("merge-databases", parts).exit_code == 0);
  CHECK(Database::open(sensed().path("merged.h5")).digest() == Database::open(sensed().sensed).digest());
}

}  // namespace voussoir
