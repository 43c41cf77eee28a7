/// @file Numbers that another unit was meant for. Oracle: the example bridges, of which all are usual, and
/// their values with a factor.

#include <catch2/catch.hpp>

#include "core/bridge_file/bridge_file.h"
#include "tests/support/bridges.h"

using namespace voussoir;
using Catch::Matchers::Contains;

namespace {

std::vector<std::string> notes_on(const std::string& text) {
  return parse_bridge_file(text, "b.toml").notes;
}

}  // namespace

TEST_CASE("No example bridge has an unusual value", "[usual-values]") {
  int bridges = 0;
  for (const auto& entry : std::filesystem::directory_iterator(test::example_bridge("small").parent_path())) {
    INFO(entry.path());
    CHECK(read_bridge_file(entry.path()).notes.empty());
    ++bridges;
  }
  CHECK(bridges >= 12);
}

TEST_CASE("A value in another unit is noted with its line, what is usual and what may be meant",
          "[usual-values]") {
  for (const auto& [text, note] :
       {std::pair("[fill]\nlevel_m = 7\nunit_weight_N_m3 = 18\n",
                  "line 3: unit_weight_N_m3 = 18: usual are 5000 to 100000; kN/m3"),
        std::pair("[material]\ndensity_kg_m3 = 2.4\n",
                  "line 2: density_kg_m3 = 2.4: usual are 500 to 10000; t/m3"),
        std::pair("[joints]\nfriction_angle_deg = 0.61\n", "line 2: friction_angle_deg = 0.61: usual are"),
        std::pair("[[regions]]\nof = [\"ring\"]\nyoung_modulus_Pa = 25\n", "line 3: young_modulus_Pa = 25:"),
        std::pair("[[loads]]\nname = \"a\"\npoints = [{x_m = 1, force_N = 5}]\n", "line 3: force_N = 5:")}) {
    INFO(text);
    const std::vector<std::string> notes = notes_on(text);
    REQUIRE(notes.size() == 1);
    CHECK_THAT(notes[0], Contains(note));
  }
  CHECK(notes_on("[joints]\nfriction_angle_deg = 0\n").empty());  // no friction is no other unit
}
