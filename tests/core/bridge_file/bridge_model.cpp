/// @file What of a bridge file does nothing. Oracle: the file's own heights and roles.

#include "core/bridge_file/bridge_model.h"

#include <catch2/catch.hpp>

#include "core/error.h"
#include "tests/support/bridges.h"
#include "tests/support/refusal.h"

using namespace voussoir;
using Catch::Matchers::Contains;

namespace {

std::vector<std::string> idle_of(const std::string& text) {
  const BridgeFile file = parse_bridge_file(text, "b.toml");
  return without_effect(file.description, model_of(file));
}

std::string refusal_of(const std::string& text) {
  return test::refusal_of([&] { model_of(parse_bridge_file(text, "b.toml")); });
}

}  // namespace

TEST_CASE("Soil below every face and regions of roles that no block has are noted", "[bridge-model]") {
  const std::string no_top = "[control_points]\ntop = false\n";
  CHECK(idle_of(no_top + "[fill]\nlevel_m = 6.5\nunit_weight_N_m3 = 18000\n").empty());
  const auto soil = idle_of("[fill]\nlevel_m = 0.5\nunit_weight_N_m3 = 18000\n");
  REQUIRE(soil.size() == 1);
  CHECK_THAT(soil[0], Contains("[fill] weighs nothing") && Contains("0.5 m high"));
  const std::string surveyed = no_top + "[fill]\nunit_weight_N_m3 = 18000\nsurface_m = ";
  CHECK(idle_of(surveyed + "[[0, 6.5], [10, 6.8], [20, 6.5]]\n").empty());
  const auto half = idle_of(surveyed + "[[2, 6.5], [10, 6.8]]\n");
  REQUIRE(half.size() == 2);
  CHECK_THAT(half[0], Contains("nothing left of x = 2 m") && Contains("goes on to x = 0 m"));
  CHECK_THAT(half[1], Contains("nothing right of x = 10 m") && Contains("goes on to x = 20 m"));
  const auto region = idle_of("[[regions]]\nof = [\"ring\", \"fill\"]\ndensity_kg_m3 = 2000\n");
  REQUIRE(region.size() == 1);
  CHECK_THAT(region[0], Contains("[[regions]] of 'fill' changes nothing"));
}

TEST_CASE("Control points that soil covers are noted (counted by hand)", "[bridge-model]") {
  // The wall is 6 m high; soil covers its left half, where corners are at x = 0, 1, 1, .. 9, 9 and,
  // twice, 10.
  const auto notes = idle_of(
      "[fill]\nunit_weight_N_m3 = 18000\nsurface_m = [[0, 6.5], [10, 6.5], [10.1, 6.0], [20, 6.0]]\n");
  REQUIRE(notes.size() == 1);
  CHECK_THAT(notes[0], Contains("lie under the soil of [fill]") && Contains("(T1, T2, T3, ..)"));
  CHECK(idle_of("[fill]\nlevel_m = 6.04\nunit_weight_N_m3 = 18000\n").empty());
}

TEST_CASE("Movements, which no scene of a database is solved under, are noted", "[bridge-model]") {
  const auto idle = idle_of("[[movements]]\nsupport = \"foot 1\"\ny_m = -0.01\n");
  REQUIRE(idle.size() == 1);
  CHECK_THAT(idle[0], Contains("[[movements]] changes nothing"));
}

TEST_CASE("Points of an intrados that do not come in their order are refused (drawn by hand)",
          "[bridge-model]") {
  const auto with_points = [](const std::string& points) {
    return refusal_of(
        "[wall]\nlength_m = 11\ncourses = 16\ncourse_height_m = 0.5\n[[spans]]\nshape = \"points\"\n"
        "points_m = [" +
        points + "]\nring_thickness_m = 0.3\nvoussoirs = 61\n");
  };
  CHECK(with_points("[2, 1], [3, 2.6], [4.5, 3.2], [6, 2.6], [7, 1]") == "accepted");
  CHECK_THAT(with_points("[2, 1], [5, 3], [5, 1], [3, 3], [6.5, 1]"), Contains("crosses itself"));
  CHECK_THAT(with_points("[2, 3], [3, 1.6], [4.5, 1], [6, 1.6], [7, 3]"),
             Contains("sags below its springings"));
  // Round a loop above itself: no corner is sharp, and the line does not cross itself, but the ring does.
  CHECK_THAT(
      with_points(
          "[2, 1], [2.2, 2.5], [3.2, 3], [4.4, 3], [5.4, 2.6], [6.3, 2.4], [7.1, 2.7], [7.3, 3.3], [7, 3.9], "
          "[6.3, 4.1], [5.4, 3.8], [4.4, 3.4], [3.2, 3.5], [2.4, 4.1], [2.4, 5], [3.2, 5.6], [5, 5.8], "
          "[7, 5.6], [8.4, 4.6], [8.8, 3], [9, 1]"),
      Contains("of ring 1 overlap"));
}

TEST_CASE("What cannot be built is refused with the name of the bridge file", "[bridge-model]") {
  CHECK_THAT(refusal_of("[[regions]]\nof = [\"rng\"]\n"),
             Contains("b.toml: of in [[regions]]: 'rng' is no block"));
  CHECK_THAT(refusal_of("[control_points]\ntop = false\narch = false\n"),
             Contains("b.toml: the bridge has no control points"));
  CHECK_THAT(refusal_of("[[walls]]\nbase_y_m = 5.5\nlength_m = 20\ncourses = 1\n"),
             Contains("b.toml: blocks '") && Contains("overlap"));
}

TEST_CASE("A part with a gap below it is refused, and one held at clamped sides is not (heights put in)",
          "[bridge-model]") {
  const auto with_parapet = [](const std::string& base, const std::string& more = "") {
    return refusal_of("[[walls]]\nrole = \"parapet\"\nbase_y_m = " + base + "\nlength_m = 20\ncourses = 1\n" +
                      more);
  };
  CHECK(with_parapet("6") == "accepted");
  CHECK_THAT(with_parapet("6.0005"), Contains("lie 0.5 mm apart"));
  CHECK_THAT(with_parapet("6.005"), Contains("lie 5 mm apart"));
  CHECK_THAT(with_parapet("7"), Contains("'13,1'") && Contains("is loose"));
  CHECK(with_parapet("7", "[supports]\nsides = \"clamped\"\n") == "accepted");
}
