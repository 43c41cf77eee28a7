/// @file What ParaView's own libraries find in the files for ParaView. Oracle: the database, and
/// query-field's CSV. tools/install-dependencies --with-checks installs the libraries; without them these
/// tests are skipped, and say so.

#include <fmt/format.h>
#include <catch2/catch.hpp>
#include <cmath>
#include <sstream>

#include "database/records/database.h"
#include "tests/support/bridges.h"
#include "tests/support/program.h"

namespace voussoir {
namespace {

/// Numbers of a line "1,2.5,nan".
std::vector<double> numbers_of(const std::string& line) {
  std::vector<double> numbers;
  std::istringstream parts(line);
  for (std::string part; std::getline(parts, part, ',');)
    numbers.push_back(std::strtod(part.c_str(), nullptr));
  return numbers;
}

struct BuiltBridge {
  test::TemporaryFolder folder;
  std::string database = (folder / "small.h5").string();

  BuiltBridge() {
    REQUIRE(test::run("build-database", {test::example_bridge("small").string(), "-o", database, "--scenes",
                                         "singles", "--xdmf", "intact;4,1..3"})
                .exit_code == 0);
  }
};

bool same(double found, double expected) {
  return found == expected || (std::isnan(found) && std::isnan(expected));
}

/// Compares the points that follow in `lines` with a scene's: all nodes of the bridge.
void check_points(std::istream& lines, const Mesh& mesh, const Field& field) {
  for (int node = 0; node < mesh.node_count(); ++node) {
    std::string line;
    REQUIRE(std::getline(lines, line));
    const auto found = numbers_of(line);
    REQUIRE(found.size() == 5);
    const bool right = found[0] == mesh.nodes(0, node) && found[1] == mesh.nodes(1, node) &&
                       same(found[2], field(0, node)) && same(found[3], field(1, node)) && found[4] == 0.0;
    if (!right) FAIL("node " << node << ": " << line);
  }
}

}  // namespace

TEST_CASE(
    "ParaView's library for XDMF finds every scene of the index with the points and displacements of the "
    "database") {
  if (!std::filesystem::exists(std::filesystem::path(VOUSSOIR_BIN_DIR) / "xdmf-contents")) {
    WARN("skipped: built without libxdmf-dev, or with sanitizers");
    return;
  }
  const BuiltBridge built;
  const Database database = Database::open(built.database);
  const test::ProgramResult read = test::run("xdmf-contents", {(built.folder / "small.xdmf").string()});
  REQUIRE(read.exit_code == 0);
  std::istringstream lines(read.out);
  for (const char* name : {"intact", "4,1", "4,2", "4,3"}) {
    const std::size_t row = *database.find(parse_scene(name, database.layout()));
    std::string head;
    REQUIRE(std::getline(lines, head));
    CHECK(head == fmt::format("{} {} {} {}", name, row, database.mesh().triangles.size(),
                              database.mesh().node_count()));
    check_points(lines, database.mesh(), database.field(row));
  }
  CHECK(lines.peek() == std::istringstream::traits_type::eof());
}

namespace {

/// What VTK found against our CSV: the number of cells, then point by point.
void compare_points(const std::string& theirs_text, const std::string& ours_text, std::size_t triangles) {
  std::istringstream found(theirs_text);
  std::istringstream expected(ours_text);
  std::size_t cells = 0;
  std::size_t points = 0;
  found >> cells >> points >> std::ws;
  CHECK(cells == triangles);
  std::string line;
  std::getline(expected, line);  // names of the columns
  std::size_t compared = 0;
  for (std::string row; std::getline(expected, row); ++compared) {
    REQUIRE(std::getline(found, line));
    const auto theirs = numbers_of(line);
    const auto ours = numbers_of(row);  // label, course, position, x, y, ux, uy
    REQUIRE(theirs.size() == 5);
    if (!std::equal(ours.end() - 4, ours.end(), theirs.begin())) FAIL(row << " was read as " << line);
  }
  CHECK(compared == points);
  CHECK(points > 200);
}

}  // namespace

TEST_CASE("VTK finds in query-field's VTU file the points, triangles and displacements of its CSV file",
          "[many-solutions]") {
  if (test::run("/usr/bin/python3", {"-c", "import vtk"}).exit_code != 0) {
    WARN("skipped: python3-vtk9 is not installed");
    return;
  }
  const BuiltBridge built;
  const Database database = Database::open(built.database);
  const std::string script = std::string(VOUSSOIR_SOURCE_DIR) + "/tests/readers/vtu_contents.py";
  using Case = std::pair<const char*, const char*>;
  for (const auto& [scene, show] :
       {Case{"intact", "displacements"}, Case{"4,1", "displacements"}, Case{"4,1", "stresses"}}) {
    const test::ProgramResult vtu =
        test::run("query-field", {scene, "-d", built.database, "--show", show, "--format", "vtu"});
    const test::ProgramResult csv =
        test::run("query-field", {scene, "-d", built.database, "--format", "csv"});
    const std::string file = (built.folder / "scene.vtu").string();
    std::ofstream(file) << vtu.out;
    const test::ProgramResult read = test::run("/usr/bin/python3", {script, file});
    INFO(read.err);
    REQUIRE(read.exit_code == 0);

    std::size_t triangles = database.mesh().triangles.size();
    for (const BlockId block : parse_scene(scene, database.layout()).removed)
      triangles -= static_cast<std::size_t>(
          database.mesh().block_triangles[static_cast<std::size_t>(value(block))].size());
    compare_points(read.out, csv.out, triangles);
  }
}

}  // namespace voussoir
