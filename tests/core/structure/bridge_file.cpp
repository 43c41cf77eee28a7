#include "core/structure/bridge_file.h"

#include <catch2/catch.hpp>

#include "core/error.h"
#include "tests/support/bridges.h"

using namespace voussoir;
using Catch::Matchers::Contains;

TEST_CASE("The reference bridge file says what the defaults say", "[bridge-file]") {
  const BridgeDescription file = reference_bridge_file().description;
  const BridgeDescription defaults;
  CHECK(file.name == defaults.name);
  CHECK(file.wall.length == defaults.wall.length);
  CHECK(file.wall.courses == defaults.wall.courses);
  CHECK(file.spans.at(0).centre_y == defaults.spans.at(0).centre_y);
  CHECK(file.joints.friction_angle == defaults.joints.friction_angle);
  CHECK(file.material.young_modulus == defaults.material.young_modulus);
  CHECK(file.mesh.split_at_corners == defaults.mesh.split_at_corners);
  CHECK(lay_blocks(file).size() == lay_blocks(defaults).size());
}

TEST_CASE("An empty bridge file is the reference bridge", "[bridge-file]") {
  CHECK(lay_blocks(parse_bridge_file("", "empty.toml").description).size() == 212);
}

TEST_CASE("Every example bridge makes a symmetric bridge with control points", "[bridge-file]") {
  for (const char* name : {"reference", "small", "two-span"}) {
    const Model bridge = make_model(read_bridge_file(test::example_bridge(name)).description);
    INFO(name);
    CHECK(bridge.symmetry.has_value());
    CHECK(bridge.control_points.size() > 30);
  }
}

TEST_CASE("Bad bridge files are refused with file, line and what was expected", "[bridge-file]") {
  const auto message = [](const std::string& text) {
    try {
      make_model(parse_bridge_file(text, "b.toml").description);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  CHECK_THAT(message("[wall]\nlength_m = \"long\"\n"),
             Contains("b.toml:2:") && Contains("expected a number"));
  CHECK_THAT(message("[wall]\nlength_m = -1\n"), Contains("b.toml:2:") && Contains("at least 0.001"));
  CHECK_THAT(message("[wall]\n\ncourses = 2.5\n"), Contains("b.toml:3:") && Contains("whole number"));
  CHECK_THAT(message("[wall]\nlenght_m = 3\n"),
             Contains("b.toml:2:") && Contains("lenght_m") && Contains("length_m"));
  CHECK_THAT(message("[wal]\n"), Contains("b.toml:1:") && Contains("unknown key 'wal'"));
  CHECK_THAT(message("name = \"a\"\nname = \"b\"\n"), Contains("b.toml:2:"));
  CHECK_THAT(message("[wall]\nbond = \"flemish\"\n"),
             Contains("b.toml:2:") && Contains("\"running\", \"stack\""));
  CHECK_THAT(message("spans = 3\n"), Contains("b.toml:1:") && Contains("[[spans]]"));
  CHECK_THAT(message("[[spans]]\ncentre_x_m = 1.0\n"), Contains("b.toml:1:") && Contains("ring reaches"));
  CHECK_THAT(message("[joints]\nnormal_stiffness_Pa_per_m = nan\n"), Contains("b.toml:2:"));
  CHECK_THAT(message("[wall]\nblock_length_m = 1e-3\n"), Contains("b.toml:1:") && Contains("blocks"));
  CHECK_THAT(message("[wall]\nblock_length_m = 1e-6\n"), Contains("b.toml:2:") && Contains("at least 0.001"));
  CHECK_THAT(message("[wall]\ncourses = 120\n[mesh]\nrefinement = 5\n"),
             Contains("b.toml:1:") && Contains("refinement of 5"));
  CHECK_THAT(message("[control_points]\ntop = false\narch = false\n"), Contains("no control points"));
  CHECK_THAT(message("= 3"), Contains("b.toml:1:"));
}

TEST_CASE("A missing bridge file is named", "[bridge-file]") {
  CHECK_THROWS_WITH(read_bridge_file("/nowhere/bridge.toml"), Contains("/nowhere/bridge.toml"));
}
