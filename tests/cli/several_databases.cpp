/// @file One bridge under several assumptions, as locate-damage is asked. Oracle: the assumptions that the
/// readings were made with, and the answers of each database alone.

#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/bridges.h"
#include "tests/support/file_text.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

namespace voussoir {
namespace {

using nlohmann::json;

/// Databases of the small bridge whose ends slide on rollers, are clamped, and of one without points on the
/// arch.
struct Assumptions {
  test::TemporaryFolder folder;
  std::string sliding = build("sliding", "roller", "true"), held = build("held", "clamped", "true"),
              without_arch = build("without-arch", "roller", "false");

  std::string build(const std::string& name, const std::string& sides, const std::string& arch) const {
    return build_from(name, test::text_of(test::example_bridge("small")) + "\n[supports]\nsides = \"" +
                                sides + "\"\n[control_points]\narch = " + arch + "\n");
  }
  std::string build_from(const std::string& name, const std::string& bridge) const {
    const std::string file = (folder / (name + ".toml")).string(),
                      database = (folder / (name + ".h5")).string();
    std::ofstream(file) << bridge;
    REQUIRE(test::run("build-database",
                      {file, "-o", database, "--scenes", "singles", "--history", "built,lost", "--quiet"})
                .exit_code == 0);
    return database;
  }
  /// Displacements of a scene as a database has them.
  std::string readings_of(const std::string& database, const std::string& scene = "intact") const {
    const std::string file = (folder / (scene + ".csv")).string();
    REQUIRE(
        test::run("make-measurements", {scene, "-d", database, "--sigma", "0.01mm", "-o", file}).exit_code ==
        0);
    return file;
  }
  static test::ProgramResult locate(std::vector<std::string> arguments,
                                    const std::vector<std::string>& databases) {
    for (const std::string& one : databases) arguments.insert(arguments.end(), {"-d", one});
    return test::run("locate-damage", arguments);
  }
};

const Assumptions& assumptions() {
  static const Assumptions made;
  return made;
}

}  // namespace

TEST_CASE("Of several databases the one answers whose assumptions the readings were made with") {
  const auto& [folder, sliding, held, without_arch] = assumptions();
  for (const std::string& truth : {sliding, held}) {
    const std::string readings = assumptions().readings_of(truth);
    const json alone = json::parse(Assumptions::locate({readings, "--format", "json"}, {truth}).out);
    CHECK_FALSE(alone.contains("databases"));
    for (const auto& order : {std::vector{sliding, held}, std::vector{held, sliding}}) {
      const json both = json::parse(Assumptions::locate({readings, "--format", "json"}, order).out);
      REQUIRE(both["databases"].size() == 2);
      CHECK(both["databases"][0]["file"] == truth);
      CHECK(both["databases"][0]["probability"] > 0.99);
      CHECK(both["databases"][0]["verdict"] == alone["verdict"]);
      CHECK(both["database"]["file"] == truth);
      CHECK(both["verdict"] == alone["verdict"]);
      CHECK(both["candidates"] == alone["candidates"]);
    }
    const std::string text = Assumptions::locate({readings}, {sliding, held}).out;
    CHECK(text.find("Databases:") < text.find("Searched:"));
    CHECK(text.find("held.h5 (digest ") != std::string::npos);
  }
}

TEST_CASE("A survey of several databases names the one that answers") {
  const auto& [folder, sliding, held, without_arch] = assumptions();
  const std::string readings = assumptions().readings_of(held);
  const json rows =
      json::parse(Assumptions::locate({readings, readings, "--format", "json"}, {sliding, held}).out);
  CHECK(rows[1]["database"] == held);
  CHECK_FALSE(
      json::parse(Assumptions::locate({readings, readings, "--format", "json"}, {held}).out)[1].contains(
          "database"));
}

TEST_CASE("What no assumption changes makes none likelier, at points that one of them holds, too") {
  const auto& [folder, sliding, held, without_arch] = assumptions();
  const std::string readings = (folder / "still.csv").string();
  std::ofstream file(readings);
  file << "point,change_mm,sigma_mm\n";
  for (int point = 1; point <= 14; ++point)
    file << 'T' << point << ',' << 0.01 * (point % 3 - 1) << ",0.01\n";
  file.close();
  // Taken as known and intact nothing moves in either, so that errors alone have to explain the readings.
  const json both = json::parse(
      Assumptions::locate({readings, "--format", "json", "--known-bridge", "--missing", "0"}, {sliding, held})
          .out);
  CHECK(both["databases"][0]["probability"].get<double>() == Approx(0.5).epsilon(1e-9));
}

TEST_CASE("A reading at a point that is held alone is no question") {
  const auto& [folder, sliding, held, without_arch] = assumptions();
  const std::string readings = (folder / "corner.csv").string();
  std::ofstream(readings) << "point,change_mm,sigma_mm\nT1,0.02,0.01\n";
  const test::ProgramResult result = Assumptions::locate({readings}, {held});
  CHECK(result.exit_code == 2);
  CHECK_THAT(result.err, Catch::Matchers::Contains("expected at least one"));
  CHECK(Assumptions::locate({readings}, {sliding}).exit_code == 0);
}

TEST_CASE("Databases that cannot be weighed against each other are refused") {
  const auto& [folder, sliding, held, without_arch] = assumptions();
  const std::string readings = assumptions().readings_of(sliding);
  const auto refused = [&](const std::vector<std::string>& options, const std::vector<std::string>& databases,
                           const std::string& reason) {
    std::vector<std::string> arguments = {readings};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const test::ProgramResult result = Assumptions::locate(arguments, databases);
    CHECK(result.exit_code == 2);
    CHECK(result.out.empty());
    CHECK_THAT(result.err, Catch::Matchers::Contains(reason));
  };
  refused({"--objective", "paper"}, {sliding, held}, "expected --objective posterior");
  std::ofstream(folder / "relative.csv") << "point,uy_mm\nT1,-0.1\nT5,-0.2\nT9,-0.2\n";
  const test::ProgramResult relative =
      Assumptions::locate({(folder / "relative.csv").string()}, {sliding, held});
  CHECK(relative.exit_code == 2);
  CHECK_THAT(relative.err, Catch::Matchers::Contains("the reading of T1 counts in " + sliding +
                                                     " and not in " + held + ", as the point is held there"));
  refused({}, {sliding, sliding}, sliding + " and " + sliding + " are the same database (digest ");
  refused({}, {sliding, without_arch},
          "unknown point 'A1', expected T1 to T14, or a sensor of a file that --sensors names (asked of " +
              without_arch + ")");
}

TEST_CASE("A database of another bridge is refused, though its sensors have the same names") {
  const auto& [folder, sliding, held, without_arch] = assumptions();
  std::string longer = test::text_of(test::example_bridge("small"));
  longer.replace(longer.find("length_m = 6.0"), 14, "length_m = 7.0");
  longer.replace(longer.find("centre_x_m = 3.0"), 16, "centre_x_m = 3.5");
  const std::string other = assumptions().build_from("longer", longer);
  const std::string readings = assumptions().readings_of(sliding);
  CHECK(Assumptions::locate({readings}, {other}).exit_code == 0);
  const test::ProgramResult both = Assumptions::locate({readings}, {sliding, other});
  CHECK(both.exit_code == 2);
  CHECK(both.out.empty());
  // The arch is half a metre further to the right.
  CHECK_THAT(both.err, Catch::Matchers::Contains("sensor A1 is at x 1.75, y 0 m in " + sliding +
                                                 " and at x 2.25, y 0 m in " + other +
                                                 ", expected at most 0.3 m in between"));
}

}  // namespace voussoir
