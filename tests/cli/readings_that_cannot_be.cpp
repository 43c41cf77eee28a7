/// Readings with a wrong sign, unit or error are said to fit nothing, instead of naming a block. Oracle: the
/// same readings as they were made, of which the answer is known.

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/not_a_number.h"
#include "tests/support/bridges.h"
#include "tests/support/file_text.h"
#include "tests/support/program.h"

using Catch::Matchers::Contains;
using voussoir::kNan;
using voussoir::test::ProgramResult;
namespace test = voussoir::test;

namespace {

/// The small bridge's singles as they are lost, the bridge not exactly known.
struct Site {
  test::TemporaryFolder folder;
  std::string database = (folder / "small.h5").string();

  Site() {
    const ProgramResult built =
        test::run("build-database", {test::example_bridge("small").string(), "-o", database, "--scenes",
                                     "singles", "--history", "built,lost", "--quiet"});
    if (built.exit_code != 0) throw std::runtime_error(built.err);
  }

  /// What is told of a point's change and its error [mm]; NaN of a silent sensor.
  using Told =
      std::function<std::pair<double, double>(const std::string& point, double change, double sigma)>;

  /// Changes of a scene, each told otherwise than it was read. Levellings, if named, have a datum of 0.3 mm.
  nlohmann::json answer(const std::string& scene, const Told& told, const std::string& error = "0.01mm",
                        const std::function<std::string(const std::string& point)>& levelling = {}) const {
    const ProgramResult made = test::run(
        "make-measurements", {scene, "-d", database, "--kind", "change", "--sigma", error, "--seed", "3"});
    REQUIRE(made.exit_code == 0);
    std::istringstream lines(made.out);
    std::string text = "point,change_mm,sigma_mm,levelling\n", point, change, sigma;
    for (std::string line; std::getline(lines, line);) {
      std::istringstream fields(line);
      std::getline(fields, point, ',') && std::getline(fields, change, ',') && std::getline(fields, sigma);
      if (line.front() == '#' || point == "point") continue;
      const auto [shown, stated] = told(point, change.empty() ? kNan : std::stod(change), std::stod(sigma));
      text += fmt::format("{},{},{},{}\n", point, std::isnan(shown) ? "" : fmt::format("{}", shown), stated,
                          levelling ? levelling(point) : "");
    }
    const std::string path = (folder / "readings.csv").string();
    std::ofstream(path) << text;
    std::vector<std::string> arguments = {path, "-d", database, "--format", "json"};
    if (levelling) arguments.insert(arguments.end(), {"--unknown-datum", "0.3mm"});
    const ProgramResult result = test::run("locate-damage", arguments);
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    return nlohmann::json::parse(result.out);
  }
};

/// What a lorry of 16 t adds to the readings of the intact small bridge, solved for itself [mm].
std::map<std::string, double> added_by_lorry(double front) {
  const test::TemporaryFolder folder;
  const std::string bridge = folder / "lorry.toml", database = folder / "lorry.h5";
  std::ofstream(bridge) << test::text_of(test::example_bridge("small"))
                        << fmt::format(
                               "[[loads]]\nname = \"lorry\"\nwidth_m = 3.0\nplace_m = {}\n"
                               "axles = [{{at_m = 0.0, force_N = 60e3}}, {{at_m = 3.6, force_N = 100e3}}]\n",
                               front);
  REQUIRE(test::run("build-database", {bridge, "-o", database, "--scenes", "intact", "--history", "built",
                                       "--loads", "all", "--known-bridge", "--quiet"})
              .exit_code == 0);
  const ProgramResult made =
      test::run("make-measurements", {"intact", "-d", database, "--load", "lorry", "--sigma", "0.0001mm"});
  REQUIRE(made.exit_code == 0);
  std::map<std::string, double> added;
  std::istringstream lines(made.out);
  std::string point, load, value;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    if (std::getline(fields, point, ',') && std::getline(fields, load, ',') &&
        std::getline(fields, value, ','))
      if (load == "lorry") added[point] = std::stod(value);
  }
  return added;
}

}  // namespace

TEST_CASE("Turned signs, metres and errors that are too small fit no scene") {
  const Site site;
  const auto as_read = [](const std::string&, double change, double sigma) {
    return std::pair(change, sigma);
  };
  CHECK(site.answer("2,4", as_read).at("verdict") == "located");
  CHECK(site.answer("intact", as_read).at("verdict") == "intact");

  const auto turned = site.answer(
      "2,4", [](const std::string&, double change, double sigma) { return std::pair(-change, sigma); });
  CHECK(turned.at("verdict") == "unexplained");
  CHECK_THAT(turned.at("fit").at("reason").get<std::string>(), Contains("signs"));

  const auto metres = site.answer(
      "2,4", [](const std::string&, double change, double sigma) { return std::pair(1e-3 * change, sigma); });
  CHECK(metres.at("verdict") == "unexplained");
  CHECK_THAT(metres.at("fit").at("reason").get<std::string>(), Contains("millimetres"));

  const auto too_sure = site.answer("intact", [](const std::string&, double change, double sigma) {
    return std::pair(change, 0.1 * sigma);
  });
  CHECK(too_sure.at("verdict") == "unexplained");
}

TEST_CASE(
    "One reading that is grossly wrong names no block (the other readings are those of an intact bridge)") {
  const Site site;
  for (const std::string wrong : {"T2", "T6", "A3"})
    for (const double off : {-1.0, -0.1, 0.1, 1.0}) {
      INFO(wrong << " off by " << off << " mm");
      const auto answer = site.answer("intact", [&](const std::string& point, double change, double sigma) {
        return std::pair(point == wrong ? change + off : change, sigma);
      });
      CHECK(answer.at("verdict") != "located");
      CHECK(answer.at("verdict") != "damaged-unlocated");
    }
}

/// One of T9 is taken for what an epoch may be, as no reading disagrees then.
TEST_CASE("Without the reading that is grossly wrong a loss is named (the same readings without it)") {
  const Site site;
  std::size_t named = 0, asked = 0;
  for (const std::string wrong : {"T2", "A3"})
    for (const double off : {-1.0, 5.0}) {
      INFO(wrong << " off by " << off << " mm");
      const auto told = [&](const std::string& point, double change, double sigma) {
        return std::pair(point == wrong ? change + off : change, sigma);
      };
      const auto answer = site.answer("2,4", told);
      CHECK(answer.at("verdict") != "located");
      ++asked;
      REQUIRE(!answer.at("without").is_null());
      const auto& without = answer.at("without");
      CHECK(without.at("sensors") == nlohmann::json::array({wrong}));
      const ProgramResult left_out =
          test::run("locate-damage", {(site.folder / "readings.csv").string(), "-d", site.database,
                                      "--without", wrong, "--format", "json"});
      REQUIRE(left_out.exit_code == 0);
      const auto alone = nlohmann::json::parse(left_out.out);
      CHECK(without.at("verdict") == alone.at("verdict"));
      CHECK(without.at("intact_probability").get<double>() ==
            Approx(alone.at("intact_probability").get<double>()).margin(1e-9));
      if (without.at("named") == nlohmann::json::array({"2,4"})) ++named;
    }
  CHECK(named == asked);
  const ProgramResult unknown = test::run(
      "locate-damage", {(site.folder / "readings.csv").string(), "-d", site.database, "--without", "T99"});
  CHECK(unknown.exit_code == 2);
  CHECK_THAT(unknown.err, Contains("--without: 'T99' has no row in the file"));
}

TEST_CASE("A lorry that stood there at one of the two times and is not stated names no block") {
  const Site site;
  // At the first time or the second. Of 1 .. 8 at both (8, second) still names a block, and (2, second) some
  // (docs/uncertainty.md).
  for (const auto& [front, time] : {std::pair(2.0, -1.0), std::pair(8.0, -1.0), std::pair(5.0, 1.0)}) {
    const std::map<std::string, double> added = added_by_lorry(front);
    REQUIRE(added.size() >= 20);
    const auto answer =
        site.answer("intact", [&, sign = time](const std::string& point, double change, double sigma) {
          return std::pair(change + sign * added.at(point), sigma);
        });
    INFO("front at " << front << ", " << time << ": " << answer.at("fit").dump());
    CHECK(answer.at("verdict") == "unexplained");
    // (5, second): two readings on one block would explain it, too, and are asked about first.
    CHECK_THAT(answer.at("fit").at("reason").get<std::string>(),
               Contains(front == 5.0 ? "may be wrong by" : "a load of about"));
  }
}

TEST_CASE("A line that was levelled apart names no block, and its own datum can be stated") {
  const Site site;
  int told_apart = 0;
  for (const std::string line : {"T", "A"})
    for (const double shift : {-1.0, -0.3, 0.3, 1.0}) {
      INFO(line << " shifted by " << shift);
      const auto told = [&](const std::string& point, double change, double sigma) {
        return std::pair(point.starts_with(line) ? change + shift : change, sigma);
      };
      const auto answer = site.answer("intact", told);
      CHECK(answer.at("verdict") != "located");
      CHECK(answer.at("verdict") != "damaged-unlocated");
      const std::string named =
          fmt::format("an error of about 0.3 mm that all readings at {}1 to {}", line, line);
      told_apart += answer.at("fit").at("reason").get<std::string>().find(named) != std::string::npos ? 1 : 0;
      const auto levelling = [](const std::string& point) { return point.substr(0, 1); };
      CHECK(site.answer("intact", told, "0.01mm", levelling).at("verdict") == "intact");
    }
  CHECK(told_apart >= 2);  // of 8, the others cannot tell as something that falls may show them, too
}

TEST_CASE("A sensor that goes on giving a value does not hide that its block is lost") {
  const Site site;
  for (const std::string lost : {"5,3", "5,4", "5,5"}) {
    INFO(lost);
    const auto kept = [](double value) {
      return [=](const std::string&, double change, double sigma) {
        return std::pair(std::isnan(change) ? value : change, sigma);
      };
    };
    CHECK(site.answer(lost, kept(kNan), "0.003mm").at("verdict") == "located");
    for (const double value : {0.001, -0.002}) {
      const auto hidden = site.answer(lost, kept(value), "0.003mm");
      CHECK(hidden.at("verdict") == "unexplained");
      // T6 is on (5,3): that this reading is wrong is asked about first.
      CHECK_THAT(hidden.at("fit").at("reason").get<std::string>(),
                 Contains(lost == "5,3" ? "only the reading at T6" : lost + " is still there"));
    }
  }
}

TEST_CASE("Readings that are coarser than their errors, or of another unit, show no intact bridge") {
  const Site site;
  const auto reason = [&](const std::string& scene, const Site::Told& told) {
    const nlohmann::json answer = site.answer(scene, told);
    CHECK(answer.at("verdict") == "unexplained");
    return answer.at("fit").at("reason").get<std::string>();
  };
  const auto rounded = [](double step) {
    return [=](const std::string&, double change, double sigma) {
      return std::pair(step * std::round(change / step), sigma);
    };
  };
  CHECK_THAT(reason("2,4", rounded(0.05)), Contains("multiples of 0.05 mm"));
  CHECK_THAT(reason("2,4", rounded(10.0)), Contains("all changes are zero"));
  CHECK_THAT(reason("intact", [](const std::string&, double change,
                                 double sigma) { return std::pair(0.1 * change, sigma); }),
             Contains("millimetres"));
  CHECK(site.answer("2,4", rounded(0.01)).at("verdict") == "located");
}

TEST_CASE("Changes of zero are believed where what was read before shows how finely (written out)") {
  const Site site;
  const auto answer = [&](double step, double sigma) {
    std::string text = "point,before_mm,after_mm,sigma_mm\n";
    for (int point = 1; point <= 12; ++point) {
      const double read = -step * (20 + point * point % 7);
      text += fmt::format("T{},{},{},{}\n", point, read, read, sigma);
    }
    const std::string path = (site.folder / "zeros.csv").string();
    std::ofstream(path) << text;
    return nlohmann::json::parse(
        test::run("locate-damage", {path, "-d", site.database, "--format", "json"}).out);
  };
  CHECK(answer(0.01, 0.01).at("verdict") != "unexplained");
  CHECK_THAT(answer(0.1, 0.01).at("fit").at("reason").get<std::string>(), Contains("multiples of 0.1 mm"));
  CHECK_THAT(answer(0.0, 0.01).at("fit").at("reason").get<std::string>(), Contains("all changes are zero"));
}

TEST_CASE(
    "Where what falls would show the readings, too, nothing that stands is named (the scene they are made "
    "of)") {
  const test::TemporaryFolder folder;
  std::ifstream example(test::example_bridge("two-ring"));
  std::stringstream text;
  text << example.rdbuf() << "\n[control_points]\nface = true\narch = false\n";
  const std::string bridge = (folder / "face.toml").string(), database = (folder / "face.h5").string();
  std::ofstream(bridge) << text.str();
  REQUIRE(test::run("build-database", {bridge, "-o", database, "--scenes", "intact;0,3;0,5", "--history",
                                       "built,lost", "--collapses", "field", "--quiet"})
              .exit_code == 0);
  const auto answer = [&](const std::string& scene) {
    const std::string path = (folder / "readings.csv").string();
    REQUIRE(test::run("make-measurements",
                      {scene, "-d", database, "--kind", "change", "--sigma", "0.02mm", "-o", path})
                .exit_code == 0);
    const ProgramResult result = test::run("locate-damage", {path, "-d", database, "--format", "json"});
    REQUIRE(result.exit_code == 0);
    return nlohmann::json::parse(result.out);
  };
  const nlohmann::json fall = answer("0,5");
  CHECK(fall.at("verdict") == "unexplained");
  CHECK_THAT(fall.at("fit").at("reason").get<std::string>(), Contains("what falls without 0,"));
  CHECK(answer("intact").at("verdict") == "intact");
}
