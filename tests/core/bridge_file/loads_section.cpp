#include "core/bridge_file/loads_section.h"

#include <catch2/catch.hpp>

#include "core/bridge_file/bridge_file.h"
#include "tests/support/bridges.h"
#include "tests/support/refusal.h"

using namespace voussoir;
using Catch::Matchers::Contains;

namespace {

const std::string kNamed = "[[loads]]\nname = \"a\"\n";

std::string message(const std::string& text) {
  return test::refusal_of([&] { parse_bridge_file(text, "b.toml"); });
}

}  // namespace

TEST_CASE("The example's load cases are read as they are written (written out)", "[bridge-file][loads]") {
  const auto loads = read_bridge_file(test::example_bridge("load-test")).description.loads;
  REQUIRE(loads.size() == 3);
  LoadDescription truck;
  truck.name = "truck";
  truck.axles = {{0.0, 60e3}, {3.6, 100e3}};
  truck.places = {8.0, 9.0, 10.0, 11.0, 12.0, 13.0, 14.0, 15.0, 16.0};
  truck.width = 3.0;
  truck.unload = true;
  CHECK(loads[0] == truck);
  CHECK(loads[1] == LoadDescription{"crown", {{10.0, 50e3}}, {}, {}, {}, 2.0, false});
  CHECK(loads[2] == LoadDescription{"crowd", {}, {{0.0, 20.0, 15e3}}, {}, {}, 3.0, false});
  CHECK(reference_bridge_file().description.loads.empty());
}

TEST_CASE("Impossible load cases are refused with file, line and what was expected", "[bridge-file][loads]") {
  CHECK_THAT(message("loads = 3\n"), Contains("b.toml:1:") && Contains("[[loads]]"));
  CHECK_THAT(message("[[loads]]\n"), Contains("b.toml:1:") && Contains("name in [[loads]]: is missing"));
  CHECK_THAT(message(kNamed), Contains("b.toml:2:") && Contains("points, lines or axles"));
  for (const char* name : {"", "thirteenbytes", "a b", "a:b", "\xC3\xA4", "all", "none"})
    CHECK_THAT(message(fmt::format("[[loads]]\nname = \"{}\"\n", name)),
               Contains("b.toml:2:") && Contains("letters, digits"));
  const std::string point = "points = [{x_m = 1, force_N = 1}]\n";
  CHECK(message(kNamed + point) == "accepted");
  CHECK_THAT(message(kNamed + point + kNamed + point), Contains("b.toml:5:") && Contains("two loads 'a'"));
  CHECK_THAT(message(kNamed + "points = [{x_m = 20.1, force_N = 1}]\n"),
             Contains("b.toml:3:") && Contains("at most 20"));
  CHECK_THAT(message(kNamed + "points = [{x_m = 1, force_N = 0}]\n"),
             Contains("b.toml:3:") && Contains("greater than 0"));
  CHECK_THAT(message(kNamed + "points = [{x_m = 1, force_N = nan}]\n"), Contains("b.toml:3:"));
  CHECK_THAT(message(kNamed + "points = [{x_m = 1}]\n"),
             Contains("b.toml:3:") && Contains("force_N") && Contains("missing"));
  CHECK_THAT(message(kNamed + "points = [{x_m = 1, force_N = 1, y_m = 2}]\n"),
             Contains("b.toml:3:") && Contains("unknown key 'y_m'"));
  CHECK_THAT(message(kNamed + "points = 3\n"), Contains("b.toml:3:") && Contains("points = [{"));
  CHECK_THAT(message(kNamed + "lines = [{from_x_m = 3, to_x_m = 3, force_N_per_m = 1}]\n"),
             Contains("b.toml:3:") && Contains("more than from_x_m = 3"));
  CHECK_THAT(message(kNamed + "lines = [{from_x_m = -1, to_x_m = 3, force_N_per_m = 1}]\n"),
             Contains("at least 0"));
  CHECK_THAT(message(kNamed + point + "width_m = 0\n"), Contains("b.toml:4:") && Contains("at least 0.001"));
  CHECK_THAT(message(kNamed + point + "weight_N = 3\n"),
             Contains("b.toml:4:") && Contains("unknown key 'weight_N'"));
}

TEST_CASE("A vehicle needs one place or a way, and an axle on the bridge everywhere",
          "[bridge-file][loads]") {
  const std::string axles = kNamed + "axles = [{at_m = 0, force_N = 1}, {at_m = 3, force_N = 1}]\n";
  CHECK(message(axles + "place_m = 22.9\n") == "accepted");
  CHECK(message(axles + "from_m = 0.0\nto_m = 23.0\nsteps = 2\n") == "accepted");
  CHECK(message(axles + "from_m = 23.0\nto_m = 0.0\nsteps = 2\n") == "accepted");
  CHECK_THAT(message(axles), Contains("b.toml:1:") && Contains("place_m in [[loads]]: is missing"));
  CHECK_THAT(message(axles + "place_m = 23.1\n"),
             Contains("b.toml:4:") && Contains("no axle is on the bridge"));
  CHECK_THAT(message(axles + "place_m = -0.1\n"),
             Contains("b.toml:4:") && Contains("no axle is on the bridge"));
  CHECK_THAT(message(axles + "place_m = 3\nfrom_m = 3\n"),
             Contains("b.toml:4:") && Contains("from_m, to_m and steps"));
  CHECK_THAT(message(axles + "from_m = 3\nto_m = 5\n"), Contains("steps") && Contains("missing"));
  CHECK_THAT(message(axles + "from_m = 3\nto_m = 5\nsteps = 1\n"),
             Contains("b.toml:6:") && Contains("from 2 to 999"));
  CHECK_THAT(message(kNamed + "points = [{x_m = 1, force_N = 1}]\nplace_m = 3\n"), Contains("axles"));
}
