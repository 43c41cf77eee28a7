#include "core/structure/loads.h"

#include <catch2/catch.hpp>

#include "core/bridge_file/bridge_file.h"
#include "core/error.h"
#include "tests/support/bridges.h"

using namespace voussoir;
using Catch::Matchers::Contains;

namespace {

LoadDescription truck() {
  LoadDescription load;
  load.name = "truck";
  load.axles = {{0.0, 60e3}, {3.0, 100e3}};
  load.places = {2.0, 5.0, 8.0};
  load.unload = true;
  return load;
}

double total(const Field& force) {
  return -force.row(1).sum();
}

double moment(const Field& force, const Mesh& mesh) {
  return -force.row(1).dot(mesh.nodes.row(0));
}

}  // namespace

TEST_CASE(
    "A vehicle gives a stage for each place and one without it, axles beside the bridge left out (written "
    "out)",
    "[loads]") {
  const Model bridge = test::small_bridge();  // from 0 to 6 m
  const auto stages = load_stages(truck(), bridge, 1.0);
  const std::vector<std::string> names = {"truck@1", "truck@2", "truck@3", "truck@off"};
  REQUIRE(stages.size() == names.size());
  // Places of the axles: 2 and -1; 5 and 2; 8 and 5 m.
  const std::vector<double> sums = {60e3, 160e3, 100e3, 0.0};
  const std::vector<double> moments = {120e3, 500e3, 500e3, 0.0};
  for (std::size_t i = 0; i < names.size(); ++i) {
    CHECK(stages[i].name == names[i]);
    CHECK(stage_names(truck())[i] == names[i]);
    CHECK(total(stages[i].force) == Approx(sums[i]).margin(1e-9));
    CHECK(moment(stages[i].force, bridge.mesh) == Approx(moments[i]).margin(1e-9));
  }
}

TEST_CASE("A load that stands still is one stage with its own name, and its parts add up (superposition)",
          "[loads]") {
  const Model bridge = test::small_bridge();
  LoadDescription points, lines, vehicle, all;
  points.points = {{1.2, 3e3}, {3.0, 5e3}};
  lines.lines = {{0.5, 4.0, 2e3}};
  vehicle.axles = {{0.5, 7e3}};
  vehicle.places = {2.0};
  all = {"all", points.points, lines.lines, vehicle.axles, vehicle.places, std::nullopt, false};
  const auto stages = load_stages(all, bridge, 1.0);
  REQUIRE(stages.size() == 1);
  CHECK(stages.front().name == "all");
  Field sum = Field::Zero(2, bridge.mesh.node_count());
  for (const LoadDescription& part : {points, lines, vehicle})
    sum += load_stages(part, bridge, 1.0).front().force;
  CHECK((stages.front().force - sum).cwiseAbs().maxCoeff() < 1e-9);
  CHECK(total(sum) == Approx(3e3 + 5e3 + 3.5 * 2e3 + 7e3));
}

TEST_CASE("Of a load that spreads over a width the bridge carries its thickness' share (closed form)",
          "[loads]") {
  const Model bridge = test::small_bridge();
  LoadDescription load;
  load.points = {{1.2, 3e3}};
  CHECK(total(load_stages(load, bridge, 0.8).front().force) == Approx(3e3));
  load.width = 2.4;
  CHECK(total(load_stages(load, bridge, 0.8).front().force) == Approx(1e3));
}

TEST_CASE("A load where there is no block is refused by name", "[loads]") {
  LoadDescription load;
  load.name = "far";
  load.points = {{7.0, 3e3}};
  CHECK_THROWS_WITH(load_stages(load, test::small_bridge(), 1.0),
                    Contains("load case 'far'") && Contains("x = 7 m"));
}
