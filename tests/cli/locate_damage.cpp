/// locate-damage and query-field as a user runs them, on the small bridge's database.

#include <fmt/format.h>
#include <hdf5.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>

#include "database/format/hdf5_handle.h"
#include "database/records/database.h"
#include "database/records/stored_bridge.h"
#include "tests/support/answer.h"
#include "tests/support/bridges.h"
#include "tests/support/program.h"

using namespace voussoir;
using Catch::Matchers::Contains;
using test::ProgramResult;

namespace {

/// A folder with the small bridge's database (built once) and room for measurement files.
struct Desk {
  test::TemporaryFolder folder;
  std::string database = (folder / "small.h5").string();

  Desk() {
    const ProgramResult built = test::run("build-database", {test::example_bridge("small").string(), "-o",
                                                             database, "--quiet", "--known-bridge"});
    if (built.exit_code != 0) throw std::runtime_error(built.err);
  }
  std::string file(const std::string& text) const {
    const std::string path = (folder / "readings.csv").string();
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }
  ProgramResult locate(const std::string& text, std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {file(text), "-d", database});
    return test::run("locate-damage", more);
  }
  /// Noise-free readings of a scene, as query-field prints them.
  std::string readings_of(const std::string& scene) const {
    const ProgramResult result =
        test::run("query-field", {scene, "-d", database, "--at", "control", "--format", "json"});
    REQUIRE(result.exit_code == 0);
    std::string csv = "point,uy_m\n";
    for (const auto& entry : nlohmann::json::parse(result.out))
      if (!entry.at("uy_m").is_null())
        csv += entry.at("point").get<std::string>() + "," + entry.at("uy_m").dump() + "\n";
    return csv;
  }
};

const Desk& desk() {
  static const Desk shared;
  return shared;
}

/// A line of a text, counted from 1.
std::string line(const std::string& text, int number) {
  std::istringstream lines(text);
  std::string found;
  for (int i = 0; i < number; ++i) std::getline(lines, found);
  return found;
}

std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

}  // namespace

TEST_CASE("locate-damage names the scene whose readings query-field printed") {
  for (const char* scene : {"intact", "4,2", "5,3", "2,1+5,6"}) {
    const ProgramResult result = desk().locate(desk().readings_of(scene), {"--format", "json"});
    INFO(scene << ": " << result.err);
    REQUIRE(result.exit_code == 0);
    const auto json = nlohmann::json::parse(result.out);
    CHECK(json.at("candidates").at(0).at("scene") == scene);
    CHECK(json.at("candidates").at(0).at("posterior").is_number());
    CHECK(json.dump().find(Database::open(desk().database).digest()) != std::string::npos);
  }
}

TEST_CASE(
    "locate-damage takes any order of rows, settlements, byte order marks, CRLF, comments and silent "
    "sensors") {
  std::vector<std::string> rows;
  std::string text = desk().readings_of("4,2");
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) rows.push_back(line);
  std::string odd = "\xEF\xBB\xBF# levelled in spring\r\npoint,settlement_mm\r\n";
  for (std::size_t i = rows.size() - 1; i > 0; --i) {
    const std::size_t comma = rows[i].find(',');
    odd += rows[i].substr(0, comma) + "," +
           (i % 5 == 0 ? "" : std::to_string(-1e3 * std::stod(rows[i].substr(comma + 1)))) + "\r\n";
  }
  const ProgramResult result = desk().locate(odd, {"--format", "json"});
  REQUIRE(result.exit_code == 0);
  CHECK(nlohmann::json::parse(result.out).at("candidates").at(0).at("scene") == "4,2");
}

TEST_CASE("Every search and format of locate-damage answers") {
  const std::string readings = desk().readings_of("4,2");
  for (const char* search : {"exhaustive", "genetic", "nearest"})
    for (const char* objective : {"paper", "posterior"}) {
      const ProgramResult result =
          desk().locate(readings, {"--search", search, "--objective", objective, "--format", "csv"});
      INFO(search << " " << objective << ": " << result.err);
      REQUIRE(result.exit_code == 0);
      CHECK(line(result.out, 2).starts_with("1,\"4,2\","));
    }
  const ProgramResult text = desk().locate(readings, {"--noise", "5%", "--top", "3"});
  CHECK_THAT(text.out, Contains("Most likely: 4,2 (course 4, 2nd from the left, x") && Contains("rank"));
}

TEST_CASE("A nearest-neighbour index that somebody put into the file is not read") {
  const std::string readings = desk().file(desk().readings_of("4,2"));
  const std::string forged = (desk().folder / "forged.h5").string();
  std::filesystem::copy_file(desk().database, forged);
  {
    const Hdf5Handle file(H5Fopen(forged.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
    REQUIRE(H5Lexists(file.get(), "search_built/trees", H5P_DEFAULT) ==
            0);  // what version 0.1 handed to FLANN
    const std::string bytes = "FLANN_INDEX" + std::string(5000, '\x7f');
    const hsize_t size = bytes.size();
    const Hdf5Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose);
    const Hdf5Handle trees(H5Dcreate2(file.get(), "search_built/trees", H5T_STD_U8LE, space.get(),
                                      H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                           H5Dclose);
    REQUIRE(H5Dwrite(trees.get(), H5T_STD_U8LE, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) >= 0);
  }
  const auto answer = [&](const std::string& database) {
    return test::run("locate-damage", {readings, "-d", database, "--search", "nearest", "--format", "csv"});
  };
  CHECK(answer(forged).exit_code == 0);
  CHECK(answer(forged).out == answer(desk().database).out);
  CHECK(test::run("locate-damage", {readings, "-d", forged, "--approximate"}).exit_code == 2);
}

TEST_CASE("A bad measurements file gives one line that names file, line and what was expected") {
  const auto message = [](const std::string& text) {
    const ProgramResult result = desk().locate(text);
    CHECK(result.exit_code == 2);
    CHECK(result.out.empty());
    CHECK(test::is_one_line(result.err));
    CHECK_THAT(result.err, Contains("readings.csv"));
    return result.err;
  };
  CHECK_THAT(message(""), Contains("empty") && Contains("expected"));
  CHECK_THAT(message("point,uy_mm\n"), Contains("expected"));
  CHECK_THAT(message("point,uy_mm\nT1,1\nT99,1\n"), Contains(":3:") && Contains("T99"));
  CHECK_THAT(message("point,uy_mm\nT1,1\nT1,2\n"), Contains(":3:") && Contains("T1"));
  CHECK_THAT(message("point,uy_mm\nT1,one\n"), Contains(":2:") && Contains("'one'"));
  CHECK_THAT(message("point,uy_inch\nT1,1\n"), Contains(":1:") && Contains("uy_inch"));
  CHECK_THAT(message("point,uy_mm\nT1,inf\n"), Contains(":2:"));
  CHECK_THAT(message("point\nT1\n"), Contains(":1:"));
}

TEST_CASE("Numbers on the command line that make no sense are refused with what was given and expected") {
  const auto message = [](const std::vector<std::string>& options) {
    const ProgramResult result = desk().locate(desk().readings_of("4,2"), options);
    CHECK(result.exit_code == 2);
    CHECK(result.out.empty());
    CHECK(test::is_one_line(result.err));
    return result.err;
  };
  CHECK_THAT(message({"--prior", "0,0,0"}), Contains("prior weights 0, 0, 0 for 0, 1, 2 missing blocks") &&
                                                Contains("expected a positive weight"));
  CHECK_THAT(message({"--prior", "1,1"}), Contains("2 prior weights, expected 3"));
  for (const char* number : {"nan", "-1", "1e400"}) {
    for (const char* option : {"--prior", "--mutation"})
      CHECK_THAT(message({option, number}), Contains(option) && Contains("expected a number from 0 to"));
    for (const char* option : {"--floor", "--unknown-datum", "--unknown-tilt"})
      CHECK_THAT(message({option, number}), Contains(option) && Contains("expected millimetres"));
  }
  CHECK_THAT(message({"--floor", "0.02cm"}), Contains("'0.02cm' given, expected millimetres from 0 to"));
  CHECK_THAT(message({"--floor", "0.02mm/m"}), Contains("such as 0.02mm"));
  CHECK_THAT(message({"--unknown-tilt", "0.02mm"}), Contains("expected millimetres per metre from 0 to"));
}

TEST_CASE("A missing, foreign or truncated database gives one line that says so") {
  const std::string readings = desk().file(desk().readings_of("4,2"));
  const auto message = [&](const std::string& database) {
    const ProgramResult result = test::run("locate-damage", {readings, "-d", database});
    CHECK((result.exit_code == 1 || result.exit_code == 2));
    CHECK(test::is_one_line(result.err));
    return result.err;
  };
  CHECK_THAT(message("/nowhere/bridge.h5"), Contains("/nowhere/bridge.h5"));
  const std::string text_file = (desk().folder / "text.h5").string();
  std::ofstream(text_file) << "not a database";
  CHECK_THAT(message(text_file), Contains("text.h5"));
  const std::string truncated = (desk().folder / "truncated.h5").string();
  std::filesystem::copy_file(desk().database, truncated, std::filesystem::copy_options::overwrite_existing);
  std::filesystem::resize_file(truncated, std::filesystem::file_size(truncated) / 2);
  CHECK_THAT(message(truncated), Contains("truncated.h5"));
  const ProgramResult other =
      test::run("locate-damage", {desk().file("point,uy_mm\nT40,1\n"), "-d", desk().database});
  CHECK(other.exit_code == 2);
  CHECK_THAT(other.err, Contains("T40"));  // the reference bridge has this point, the small one has not
}

TEST_CASE("query-field gives points by name, place and set, and refuses what is not there") {
  const auto query = [](std::vector<std::string> more) {
    more.insert(more.end(), {"-d", desk().database});
    return test::run("query-field", more);
  };
  const auto json = nlohmann::json::parse(query({"4,2", "--at", "T3,A2", "--format", "json"}).out);
  REQUIRE(json.size() == 2);
  CHECK(json.at(0).at("point") == "T3");
  const Database database = Database::open(desk().database);
  const std::size_t row = database.find(parse_scene("4,2", database.layout())).value();
  CHECK(json.at(0).at("uy_m").get<double>() == database.table().row(row)[2]);
  CHECK_THAT(query({"4,2", "--format", "vtu"}).out, Contains("<VTKFile"));
  for (const std::vector<std::string>& bad :
       {std::vector<std::string>{"99,1"}, {"4,2", "--at", "Z9"}, {"4,2+4,2"}}) {
    const ProgramResult result = query(bad);
    CHECK(result.exit_code == 2);
    CHECK(test::is_one_line(result.err));
  }
}

TEST_CASE("Where blocks meet query-field gives the displacement of each (a micrometre to either side)") {
  const Database database = Database::open(desk().database);
  const Model bridge = bridge_of(database);
  const Joint& joint = bridge.joints.front();
  const auto ends = ends_of(joint, database.mesh());
  const Point middle = 0.5 * (ends[0] + ends[1]), along = ends[1] - ends[0];
  const auto shown = [&](const Point& at) {
    const ProgramResult result = test::run(
        "query-field",
        {"intact", "-d", desk().database, "--at", fmt::format("{},{}", at.x(), at.y()), "--format", "json"});
    INFO(result.err);
    return nlohmann::json::parse(result.out);
  };
  const Point aside = 1e-6 * Point(-along.y(), along.x()).normalized();
  std::vector<double> of_each;
  for (const Point& at : {Point(middle + aside), Point(middle - aside)}) {
    REQUIRE(shown(at).size() == 1);
    of_each.push_back(shown(at).at(0).at("uy_m"));
  }
  const nlohmann::json both = shown(middle);
  REQUIRE(both.size() == 2);
  for (const auto& one : both) CHECK_THAT(one.at("point").get<std::string>(), Contains(" of block "));
  const double first = both.at(0).at("uy_m"), second = both.at(1).at("uy_m");
  const double crosswise = std::abs(first - of_each[1]) + std::abs(second - of_each[0]);
  CHECK(std::min(std::abs(first - of_each[0]) + std::abs(second - of_each[1]), crosswise) < 2e-9);
  CHECK(std::abs(first - second) > 1e-8);  // the joint closes by more
}

TEST_CASE("query-field gives at a triangle's centroid the mean of its corners (linear shape functions)") {
  const Database database = Database::open(desk().database);
  const Mesh& mesh = database.mesh();
  const Field field = database.field(database.find(parse_scene("4,2", database.layout())).value());
  int compared = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 17) {
    Point place = Point::Zero();
    Point expected = Point::Zero();
    for (const NodeId node : mesh.triangles[t].nodes) {
      place += mesh.position(node) / 3.0;
      expected += field.col(value(node)) / 3.0;
    }
    if (expected.hasNaN()) continue;  // in the removed block
    const std::string at = fmt::format("{},{}", place.x(), place.y());
    const ProgramResult result =
        test::run("query-field", {"4,2", "-d", desk().database, "--at", at, "--format", "json"});
    INFO(at << result.err);
    const auto json = nlohmann::json::parse(result.out);
    CHECK(json.at(0).at("ux_m").get<double>() == Approx(expected.x()).epsilon(1e-9).margin(1e-15));
    CHECK(json.at(0).at("uy_m").get<double>() == Approx(expected.y()).epsilon(1e-9).margin(1e-15));
    ++compared;
  }
  CHECK(compared > 5);
}

TEST_CASE("query-field draws every block that is there, and its colours span the field's displacements") {
  const ProgramResult drawn = test::run("query-field", {"4,2", "-d", desk().database, "--format", "svg"});
  REQUIRE(drawn.exit_code == 0);
  const Database database = Database::open(desk().database);
  const Field field = database.field(database.find(parse_scene("4,2", database.layout())).value());
  CHECK(occurrences(drawn.out, "class=\"outline\"") == database.layout().size() - 1);
  CHECK(occurrences(drawn.out, "class=\"gone\"") == 1);
  double lowest = INFINITY, highest = -INFINITY;  // [mm]
  for (const double uy : field.row(1)) {
    if (std::isnan(uy)) continue;
    lowest = std::min(lowest, 1e3 * uy);
    highest = std::max(highest, 1e3 * uy);
  }
  CHECK_THAT(drawn.out, Contains("times larger"));
  // The bar is half as wide as the picture's 1040 units, in its middle; places are written to a tenth.
  const std::regex mark(
      "<text x=\"([0-9.]+)\" y=\"[0-9.]+\" text-anchor=\"middle\" class=\"small\">([-0-9.]+)<");
  int marks = 0;
  for (std::sregex_iterator at(drawn.out.begin(), drawn.out.end(), mark), none; at != none; ++at, ++marks)
    CHECK(std::stod((*at)[1]) ==
          Approx(260.0 + 520.0 * (highest - std::stod((*at)[2])) / (highest - lowest)).margin(0.06));
  CHECK(marks >= 3);
  CHECK(test::run("query-field", {"4,2", "-d", desk().database, "--format", "svg", "--at", "T3"}).exit_code ==
        2);
}

TEST_CASE("locate-damage writes its answer as a page beside the usual answer") {
  const std::string page = (desk().folder / "report.html").string();
  const ProgramResult result = desk().locate(desk().readings_of("4,2"), {"--report", page, "--top", "3"});
  REQUIRE(result.exit_code == 0);
  CHECK_THAT(result.out, Contains("Most likely: 4,2 ("));
  std::ifstream stream(page);
  const std::string html{std::istreambuf_iterator<char>(stream), {}};
  const std::size_t first_row = html.find("<td class=\"number\">1</td>");
  REQUIRE(first_row != std::string::npos);
  CHECK(html.substr(first_row).starts_with("<td class=\"number\">1</td><td>4,2</td>"));
  const Database database = Database::open(desk().database);
  CHECK_THAT(html, Contains(database.digest()) && Contains("</html>"));
  for (const Block& block : database.layout().blocks)
    CHECK_THAT(html, Contains("<title>Block (" + to_string(block.index) + ")"));
}

TEST_CASE("A report named .svg is the picture of the bridge alone") {
  const std::string picture = (desk().folder / "bridge.svg").string();
  REQUIRE(desk().locate(desk().readings_of("4,2"), {"--report", picture}).exit_code == 0);
  std::ifstream stream(picture);
  const std::string svg{std::istreambuf_iterator<char>(stream), {}};
  CHECK(svg.starts_with("<svg "));
  CHECK_THAT(svg, Contains("(4,2)</text>") && !Contains("<html"));
  CHECK(occurrences(svg, ")</text>") == 1);
}

TEST_CASE("A report that cannot be written is a failure, and then there is no answer either") {
  const ProgramResult result = desk().locate(desk().readings_of("4,2"), {"--report", "/nowhere/report.html"});
  CHECK(result.exit_code == 1);
  CHECK(result.out.empty());
  CHECK(test::is_one_line(result.err));
  CHECK_THAT(result.err, Contains("/nowhere/report.html"));
}

TEST_CASE("Programs tell their version and show an example in their help") {
  for (const char* name : {"build-database", "verify-database", "locate-damage", "query-field"}) {
    CHECK(test::run(name, {"--version"}).exit_code == 0);
    const ProgramResult help = test::run(name, {"--help"});
    CHECK(help.exit_code == 0);
    CHECK_THAT(help.out, Contains("xample"));
    CHECK(test::run(name, {"--no-such-option"}).exit_code == 2);
  }
}
