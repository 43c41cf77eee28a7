#include "core/structure/top_surface.h"

#include <catch2/catch.hpp>
#include <random>

#include "core/error.h"
#include "tests/support/bridges.h"

using namespace voussoir;

namespace {

Block rectangle(const std::string& label, double left, double bottom, double right, double top) {
  Block block;
  block.label = label;
  block.polygon = {{left, bottom}, {right, bottom}, {right, top}, {left, top}};
  return block;
}

Mesh mesh_of(std::vector<Block> blocks) {
  return assemble(std::move(blocks), {}).mesh;
}

/// Downward force of all nodes and its moment about x = 0.
Point resultant(const Field& load, const Mesh& mesh) {
  return {-load.row(1).sum(), -load.row(1).dot(mesh.nodes.row(0))};
}

double on_block(const Field& load, const Mesh& mesh, std::size_t block) {
  return -load.row(1).segment(mesh.block_nodes[block].begin, mesh.block_nodes[block].size()).sum();
}

Field nothing(const Mesh& mesh) {
  return Field::Zero(2, mesh.node_count());
}

// Round-off of some ten operations on forces of 1e5 N and places up to 20 m.
constexpr double kRoundOff = 1e-8;

}  // namespace

TEST_CASE("A point force on one block is shared as a lever shares it (closed form)", "[loads]") {
  const Mesh mesh = mesh_of({rectangle("a", 1.0, 0.0, 3.0, 1.0)});
  Field load = nothing(mesh);
  TopSurface(mesh).add_force(1.5, 8.0, load);
  for (int node = 0; node < mesh.node_count(); ++node) {
    const bool top = mesh.nodes(1, node) == 1.0;
    const double expected = !top ? 0.0 : mesh.nodes(0, node) == 1.0 ? 6.0 : 2.0;
    CHECK(-load(1, node) == Approx(expected).margin(1e-15));
    CHECK(load(0, node) == 0.0);
  }
}

TEST_CASE("Forces at any place of the reference bridge have the sum and the moment of the load", "[loads]") {
  const Mesh mesh = test::reference_bridge().mesh;
  const TopSurface top(mesh);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> place(0.0, 20.0);
  for (int trial = 0; trial < 100; ++trial) {
    const double x = trial == 0 ? 0.0 : trial == 1 ? 20.0 : trial == 2 ? 10.0 : place(random);
    Field load = nothing(mesh);
    top.add_force(x, 1e5, load);
    CHECK((resultant(load, mesh) - Point(1e5, 1e5 * x)).norm() < kRoundOff);
  }
}

TEST_CASE("A line load has its closed-form sum and moment and is what many points give", "[loads]") {
  const Mesh mesh = test::reference_bridge().mesh;
  const TopSurface top(mesh);
  const double left = 2.3, right = 17.9, per_length = 1e4;
  Field line = nothing(mesh), points = nothing(mesh);
  top.add_line(left, right, per_length, line);
  const double sum = per_length * (right - left);
  CHECK((resultant(line, mesh) - Point(sum, sum * 0.5 * (left + right))).norm() < kRoundOff * 10.0);
  constexpr int kPoints = 10000;
  const double step = (right - left) / kPoints;
  for (int i = 0; i < kPoints; ++i) top.add_force(left + (i + 0.5) * step, per_length * step, points);
  // Points are exact but in the steps in which an edge ends: there a node's share is off by part of a step's
  // force.
  CHECK((line - points).cwiseAbs().maxCoeff() < per_length * step);
  CHECK(line.cwiseAbs().maxCoeff() > 100.0 * per_length * step);
}

TEST_CASE("The highest block carries the load; where two of one height meet, both (written out)", "[loads]") {
  const Mesh mesh = mesh_of({rectangle("below", 0.0, 0.0, 2.0, 1.0), rectangle("above", 1.0, 1.0, 2.0, 2.0),
                             rectangle("beside", 2.0, 0.0, 3.0, 1.0), rectangle("next", 3.0, 0.0, 4.0, 1.0)});
  const TopSurface top(mesh);
  for (const auto& [x, expected] : {std::pair{0.5, std::array{8.0, 0.0, 0.0, 0.0}},
                                    {1.5, {0.0, 8.0, 0.0, 0.0}},
                                    {1.0, {0.0, 8.0, 0.0, 0.0}},
                                    {2.0, {0.0, 8.0, 0.0, 0.0}},
                                    {2.5, {0.0, 0.0, 8.0, 0.0}},
                                    {3.0, {0.0, 0.0, 4.0, 4.0}}}) {
    Field load = nothing(mesh);
    top.add_force(x, 8.0, load);
    for (std::size_t block = 0; block < 4; ++block) CHECK(on_block(load, mesh, block) == expected.at(block));
  }
  Field line = nothing(mesh);
  top.add_line(0.5, 3.5, 2.0, line);
  for (std::size_t block = 0; block < 4; ++block)
    CHECK(on_block(line, mesh, block) == Approx(std::array{1.0, 2.0, 2.0, 1.0}.at(block)).epsilon(1e-12));
}

TEST_CASE("Where there is no block a load is refused with its place", "[loads]") {
  const Mesh mesh = mesh_of({rectangle("a", 0.0, 0.0, 1.0, 1.0), rectangle("b", 2.0, 0.0, 3.0, 1.0)});
  const TopSurface top(mesh);
  Field load = nothing(mesh);
  CHECK_FALSE(top.is_under(1.5));
  CHECK_THROWS_WITH(top.add_force(1.5, 1.0, load), Catch::Contains("no block under x = 1.5 m"));
  CHECK_THROWS_WITH(top.add_line(0.5, 2.5, 1.0, load), Catch::Contains("no block under x = 1.5 m"));
  CHECK_THROWS_WITH(top.add_line(-1.0, 0.5, 1.0, load), Catch::Contains("x = -1 m"));
  CHECK_THROWS_WITH(top.add_line(2.5, 3.5, 1.0, load), Catch::Contains("x = 3.5 m"));
}

TEST_CASE("Soil whose surface crosses the top has the area and the middle of what is above (triangles)",
          "[loads]") {
  const Mesh mesh = mesh_of({rectangle("a", 0.0, 0.0, 4.0, 1.0)});
  const TopSurface top(mesh);
  // A triangle of base b and height h whose top is at its end weighs b h / 2 at b / 3 from that end.
  const auto check = [&](const std::vector<Point>& surface, double area, double middle) {
    Eigen::VectorXd masses = Eigen::VectorXd::Zero(mesh.node_count());
    top.add_soil(surface, 2000.0, masses);
    CHECK(masses.sum() == Approx(2000.0 * area).epsilon(1e-12));
    CHECK(masses.dot(mesh.nodes.row(0).transpose()) == Approx(2000.0 * area * middle).epsilon(1e-12));
  };
  check({{0.0, 0.5}, {4.0, 1.5}}, 0.5, 4.0 - 2.0 / 3.0);
  check({{0.0, 1.2}, {4.0, 0.2}}, 0.5 * 0.8 * 0.2, 0.8 / 3.0);
  check({{-1.0, 2.0}, {1.0, 2.0}, {3.0, 0.0}, {4.0, 0.0}}, 1.0 + 0.5, (0.5 + 0.5 * (1.0 + 1.0 / 3.0)) / 1.5);
}
