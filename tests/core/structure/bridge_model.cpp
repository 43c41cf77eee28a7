/// @file What of a bridge file does nothing. Oracle: the file's own heights and roles.

#include "core/structure/bridge_model.h"

#include <catch2/catch.hpp>

#include "core/error.h"
#include "tests/support/bridges.h"

using namespace voussoir;
using Catch::Matchers::Contains;

namespace {

std::vector<std::string> idle_of(const std::string& text) {
  const BridgeFile file = parse_bridge_file(text, "b.toml");
  return without_effect(file.description, model_of(file));
}

std::string refusal_of(const std::string& text) {
  try {
    model_of(parse_bridge_file(text, "b.toml"));
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("Soil below every face and regions of roles that no block has are noted", "[bridge-model]") {
  CHECK(idle_of("[fill]\nlevel_m = 6.5\nunit_weight_N_m3 = 18000\n").empty());
  const auto soil = idle_of("[fill]\nlevel_m = 0.5\nunit_weight_N_m3 = 18000\n");
  REQUIRE(soil.size() == 1);
  CHECK_THAT(soil[0], Contains("[fill] weighs nothing") && Contains("0.5 m high"));
  const auto region = idle_of("[[regions]]\nof = [\"ring\", \"fill\"]\ndensity_kg_m3 = 2000\n");
  REQUIRE(region.size() == 1);
  CHECK_THAT(region[0], Contains("[[regions]] of 'fill' changes nothing"));
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
