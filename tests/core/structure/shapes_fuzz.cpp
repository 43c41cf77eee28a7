/// @file Random bridges of every shape. Oracle: each meshes into triangles that fill its blocks, and Newton's
/// method on it ends with finite displacements; wrong files are refused with file and words.

#include <catch2/catch.hpp>
#include <cmath>

#include "core/bridge_file/bridge_file.h"
#include "core/error.h"
#include "core/statics/quasi_static_solver.h"
#include "core/structure/model.h"
#include "tests/support/fuzzing.h"

using namespace voussoir;

namespace {

double between(test::Chance& chance, double low, double high) {
  return low + (high - low) * static_cast<double>(chance() >> 11) * 0x1p-53;
}

/// With fewer the straight back of an outer voussoir can cut through the inner ring where the haunch bends;
/// such a file is refused ("turned inside out").
constexpr unsigned kFewestOfRings = 9;

/// A span between x = 1 and x = 1 + width at most, with its rings, as a bridge file says it.
std::string random_span(const std::string& shape, test::Chance& chance) {
  const double span = between(chance, 2.0, 5.0);
  const double thickness = between(chance, 0.1, 0.15) * span;
  std::string text = "[[spans]]\nshape = \"" + shape + "\"\n";
  const double springing = between(chance, 0.0, 1.0) < 0.2 ? 0.0 : between(chance, 0.1, 1.5);
  if (shape == "semicircular")
    text += fmt::format("centre_x_m = 5\ncentre_y_m = {}\nintrados_radius_m = {}\n", springing, 0.5 * span);
  else if (shape == "points")
    text += fmt::format("points_m = [[{}, {}], [{}, {}], [5, {}], [{}, {}], [{}, {}]]\n", 5 - 0.5 * span,
                        springing, 5 - 0.3 * span, springing + between(chance, 0.22, 0.3) * span,
                        springing + between(chance, 0.35, 0.45) * span, 5 + 0.3 * span,
                        springing + between(chance, 0.22, 0.3) * span, 5 + 0.5 * span, springing);
  else
    text +=
        fmt::format("centre_x_m = 5\nspringing_m = {}\nspan_m = {}\nrise_m = {}\n", springing, span,
                    span * (shape == "pointed" ? between(chance, 0.55, 0.9) : between(chance, 0.2, 0.45)));
  if (chance() % 3 == 0)
    text += fmt::format(
        "rings = [{{thickness_m = {}, voussoirs = {}}}, {{thickness_m = {}, voussoirs = {}, staggered = "
        "{}}}]\n",
        0.5 * thickness, kFewestOfRings + chance() % 16, 0.5 * thickness, kFewestOfRings + chance() % 16,
        chance() % 2 == 0);
  else if (chance() % 2 == 0)
    text += fmt::format("ring_thickness_m = {}\nvoussoirs = {}\n", thickness, 5 + chance() % 25);
  else
    text +=
        fmt::format("ring_thickness_m = {}\nvoussoir_length_m = {}\n", thickness, between(chance, 0.2, 1.0));
  if (shape != "semicircular" && chance() % 2 == 0)
    text += fmt::format("skewback_m = {}\n", between(chance, 0.0, 0.5));
  return text;
}

std::string random_file(const std::string& shape, test::Chance& chance) {
  const bool walls = chance() % 4 != 0;
  const double course = between(chance, 0.3, 0.8);
  std::string text = fmt::format(
      "[wall]\nlength_m = 10\ncourses = {}\ncourse_height_m = {}\nblock_length_m = {}\nbond = \"{}\"\n",
      walls ? static_cast<int>(std::ceil(7.5 / course)) : 0, course, between(chance, 0.6, 2.0),
      chance() % 2 == 0 ? "running" : "stack");
  text += random_span(shape, chance);
  if (chance() % 3 == 0) text += "[fill]\nunit_weight_N_m3 = 18000\nlevel_m = 8.2\n";
  if (chance() % 3 == 0)
    text += "[[regions]]\nof = [\"ring\"]\nyoung_modulus_Pa = 1e10\nfriction_angle_deg = 40\n";
  return text;
}

const std::vector<std::string> kShapes = {"semicircular",  "segmental", "pointed",
                                          "three-centred", "elliptic",  "points"};

/// Nothing of a ring without walls that springs above the ground, which is refused.
std::optional<Model> model_if_carried(const std::string& text) {
  const BridgeDescription description = parse_bridge_file(text, "random.toml").description;
  if (description.wall.courses > 0) return make_model(description);
  try {
    return make_model(description);
  } catch (const InputError& error) {
    CHECK_THAT(error.what(), Catch::Contains("is loose"));
    return std::nullopt;
  }
}

void mesh_and_solve(const std::string& text) {
  const std::optional<Model> carried = model_if_carried(text);
  if (!carried) return;
  const Model& bridge = *carried;
  for (std::size_t block = 0; block < bridge.layout.size(); ++block) {
    double filled = 0.0;
    for (int t = bridge.mesh.block_triangles[block].begin; t < bridge.mesh.block_triangles[block].end; ++t) {
      const auto& [a, b, c] = bridge.mesh.triangles[static_cast<std::size_t>(t)].nodes;
      const double part = area({bridge.mesh.position(a), bridge.mesh.position(b), bridge.mesh.position(c)});
      REQUIRE(part > 0.0);
      filled += part;
    }
    REQUIRE(filled == Approx(area(bridge.layout.blocks[block].polygon)).epsilon(1e-9));
  }
  REQUIRE(!bridge.joints.empty());
  QuasiStaticSolver solver(bridge);
  const Solution solution = solver.solve(Scene{});
  REQUIRE(solution.displacement.allFinite());
}

void try_valid(int each, std::uint64_t seed) {
  test::Chance chance(seed);
  for (int i = 0; i < each; ++i)
    for (const std::string& shape : kShapes) {
      const std::string text = random_file(shape, chance);
      INFO(text);
      mesh_and_solve(text);
    }
}

int refused(int count, std::uint64_t seed) {
  const std::vector<std::string> nasty = {"nan",
                                          "1e308",
                                          "-1",
                                          "0",
                                          "[[1,2],[3]]",
                                          "\"round\"",
                                          "rise_m = 0\n",
                                          "span_m = 1e5\n",
                                          "points_m = []\n",
                                          "rings = [{}]\n",
                                          "rings = 3\n",
                                          "skewback_m = -1\n",
                                          "shape = 3\n",
                                          "of = []\n",
                                          "level_m = nan\n",
                                          "[[walls]]\n",
                                          "voussoirs = 2\n",
                                          "staggered = 1\n"};
  test::Chance chance(seed);
  int result = 0;
  for (int i = 0; i < count; ++i) {
    const std::string text =
        test::damaged_text({random_file(kShapes[chance() % kShapes.size()], chance)}, nasty, chance);
    INFO(text);
    try {
      const BridgeDescription description = parse_bridge_file(text, "wrong.toml").description;
      if (lay_blocks(description).size() < 500) make_model(description);
    } catch (const InputError& error) {
      REQUIRE(!std::string(error.what()).empty());
      ++result;
    }
  }
  return result;
}

}  // namespace

TEST_CASE("Five random bridges of every shape mesh and solve", "[shapes][fuzz]") {
  try_valid(5, 1);
}

TEST_CASE("A thousand random bridges of every shape mesh and solve", "[.long][shapes][fuzz]") {
  try_valid(1000, 2);
}

TEST_CASE("Six hundred damaged files of every shape make a bridge or are refused", "[shapes][fuzz]") {
  CHECK(refused(600, 3) > 200);
}

TEST_CASE("A thousand wrong files and more of every shape are refused", "[.long][shapes][fuzz]") {
  CHECK(refused(10'000, 4) > 1'000);
}
