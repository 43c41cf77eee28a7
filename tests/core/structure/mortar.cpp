/// @file Which joints have mortar, halved blocks and held tops. Oracles: counts and places of the bond by
/// hand.

#include <catch2/catch.hpp>
#include <set>

#include "core/error.h"
#include "core/statics/quasi_static_solver.h"
#include "core/structure/halved_blocks.h"
#include "core/structure/mortar_regions.h"
#include "tests/support/bridges.h"

using namespace voussoir;

namespace {

const std::string kMortar =
    "tensile_strength_Pa = 0.25e6\nopening_energy_J_m2 = 18\ncohesion_Pa = 0.35e6\nslip_energy_J_m2 = 125\n";
const std::string kStiffJoints =
    "[joints]\nnormal_stiffness_Pa_per_m = 82e9\ntangential_stiffness_Pa_per_m = 36e9\n"
    "friction_angle_deg = 30\n";

BridgeDescription description_of(const std::string& text) {
  return parse_bridge_file(text, "b.toml").description;
}

/// Joints of a bridge with mortar.
int mortared(const Model& model) {
  return static_cast<int>(std::ranges::count_if(
      model.parameters.joints, [](const JointMaterial& joint) { return joint.mortar.is_there(); }));
}

std::string refusal(const std::string& text) {
  try {
    make_model(description_of(text));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

bool between(const Model& model, const Joint& joint, BlockRole a, BlockRole b) {
  const BlockRole first = model.layout[joint.first].role;
  const BlockRole second = model.layout[joint.second].role;
  return (first == a && second == b) || (first == b && second == a);
}

}  // namespace

TEST_CASE("Mortar is laid between the roles and blocks that a region names", "[mortar][bridge-file]") {
  const std::string text = kStiffJoints + "[[mortar]]\nbetween = [\"ring\", \"ring\"]\n" + kMortar;
  const Model model = make_model(description_of(text));
  for (std::size_t j = 0; j < model.joints.size(); ++j)
    CHECK(model.parameters.joints[j].mortar.is_there() ==
          between(model, model.joints[j], BlockRole::ring, BlockRole::ring));
  CHECK(!model.parameters.contact.mortar.is_there());
  const Model everywhere = make_model(description_of(kStiffJoints + "[[mortar]]\n" + kMortar));
  CHECK(mortared(everywhere) == static_cast<int>(everywhere.joints.size()));
  const Model one =
      make_model(description_of(kStiffJoints + "[[mortar]]\nbetween = [\"1,1\", \"2,1\"]\n" + kMortar));
  CHECK(mortared(one) == 1);
  const Model but_one = make_model(description_of(kStiffJoints + "[[mortar]]\n" + kMortar +
                                                  "[[mortar]]\nbetween = [\"1,1\", \"2,1\"]\ndry = true\n"));
  CHECK(mortared(but_one) == mortared(everywhere) - 1);
}

TEST_CASE("What a mortar cannot be is refused with key and value", "[mortar][bridge-file]") {
  const std::string table = kStiffJoints + "[[mortar]]\n";
  CHECK(refusal(table + "tensile_strength_Pa = 1e5\n") ==
        "b.toml:5: opening_energy_J_m2 in [[mortar]]: is missing");
  CHECK(refusal(table + "tensile_strength_Pa = 0.25e6\nopening_energy_J_m2 = 0.1\ncohesion_Pa = 0.35e6\n"
                        "slip_energy_J_m2 = 125\n") ==
        "b.toml:7: opening_energy_J_m2 in [[mortar]]: is 0.1: expected more than f_t^2 / (2 p_n) = 0.381098: "
        "the joint would break at once");
  CHECK(refusal(table + "tensile_strength_Pa = 0.25e6\nopening_energy_J_m2 = 18\ncohesion_Pa = 0.1e6\n"
                        "slip_energy_J_m2 = 125\n") ==
        "b.toml:8: cohesion_Pa in [[mortar]]: is 100000: expected at least tan(friction_angle) "
        "tensile_strength_Pa = 144338");
  CHECK(refusal(table + "tensile_strength_Pa = 0.25e6\nopening_energy_J_m2 = 18\ncohesion_Pa = 0.35e6\n"
                        "slip_energy_J_m2 = 1\n")
            .find("slip_energy_J_m2 in [[mortar]]: is 1: expected more than c^2 / p_t = 3.40278") !=
        std::string::npos);
  CHECK(refusal(table + kMortar + "compressive_strength_Pa = 10.5e6\ncrushing_energy_J_m2 = 1000\n")
            .find("crushing_energy_J_m2 in [[mortar]]: is 1000: expected more than f_m^2 / p_n of "
                  "compressive_strength_Pa = 1344.51") != std::string::npos);
  CHECK(refusal(table + kMortar + "between = [\"ring\"]\n").find("has 1 names: expected two") !=
        std::string::npos);
  CHECK(refusal(table + kMortar + "between = [\"ring\", \"99,1\"]\n").find("'99,1' is no block") !=
        std::string::npos);
  CHECK(refusal(table + kMortar + "within_blocks = true\n").find("expected halved = true") !=
        std::string::npos);
  CHECK(refusal("[wall]\nhalved = true\n").find("expected a table [[mortar]] with within_blocks = true") !=
        std::string::npos);
}

TEST_CASE("Halved blocks meet where the bond says, in the middle of whole ones (counted by hand)",
          "[mortar][bridge-file]") {
  const Model wall = make_model(read_bridge_file(test::example_bridge("eindhoven-wall")).description);
  CHECK(wall.block_count() == 18 * 9);  // every course: four bricks and a half
  int within = 0;
  for (std::size_t j = 0; j < wall.joints.size(); ++j)
    if (wall.parameters.joints[j].normal_stiffness == 1e13) ++within;
  CHECK(within == 2 * 18 * 4);  // refined once: two stretches a joint
  CHECK(mortared(wall) == static_cast<int>(wall.joints.size()));
  const Support& top = wall.supports.back();
  CHECK(top.name == "top");
  for (const NodeId node : top.nodes) CHECK(wall.mesh.position(node).y() > 17 * 0.0625 - 1e-9);
  for (const NodeId node : wall.supports.front().nodes) CHECK(wall.mesh.position(node).y() < 0.0625 + 1e-9);
}

TEST_CASE("Mortar as rough as the joints is taken whatever the angle (all half degrees)",
          "[mortar][bridge-file]") {
  const std::string stiffness = kStiffJoints.substr(0, kStiffJoints.find("friction"));
  for (double angle = 10.0; angle <= 54.0; angle += 0.5) {
    const std::string degrees = fmt::format("friction_angle_deg = {:.1f}\n", angle);
    CHECK(refusal(stiffness + degrees + "[[mortar]]\n" + kMortar + degrees) == "");
  }
}

TEST_CASE("Blocks of other walls are not halved, and no joint between them is one of halves (by hand)",
          "[mortar][bridge-file]") {
  BridgeDescription description;
  description.spans.clear();
  description.wall = {.length = 4.0, .courses = 2, .halved = true};
  WallPart parapet;
  parapet.courses = {.length = 3.0, .courses = 1};
  parapet.role = BlockRole::parapet;
  parapet.from_x = 0.25;
  parapet.base_y = 1.0;
  description.parts = {parapet};
  MortarRegion within;
  within.within_blocks = true;
  within.normal_stiffness = 1e13;
  description.mortar = {within};
  const Model bridge = make_model(description);
  // Courses of four blocks, and of three between two halves, all whole ones cut; on top two between two
  // halves.
  CHECK(bridge.block_count() == 8 + 8 + 4);
  int halves = 0;
  for (std::size_t j = 0; j < bridge.joints.size(); ++j)
    if (bridge.parameters.joints[j].normal_stiffness == 1e13) ++halves;
  CHECK(halves == 4 + 3);
}

TEST_CASE("A bridge whose mortar is said to be none is the dry bridge to the last bit", "[mortar]") {
  const BridgeDescription plain = test::small_description();
  BridgeDescription dry = plain;
  dry.mortar = {MortarRegion{}};
  const Model a = make_model(plain);
  const Model b = make_model(dry);
  QuasiStaticSolver first(a);
  QuasiStaticSolver second(b);
  const Scene scene{.removed = {*a.layout.find({3, 1})}};
  CHECK((first.solve(scene).displacement.array().isNaN() == second.solve(scene).displacement.array().isNaN())
            .all());
  CHECK(without_nan(first.solve(scene).displacement) == without_nan(second.solve(scene).displacement));
}

TEST_CASE("Movements are read, and what they cannot be is refused", "[mortar][bridge-file]") {
  const BridgeDescription wall = read_bridge_file(test::example_bridge("eindhoven-wall")).description;
  REQUIRE(wall.movements.size() == 2);
  CHECK(wall.movements[0] == MovementDescription{.support = "top", .pressure = 0.3e6});
  CHECK(wall.movements[1] == MovementDescription{.support = "top", .pressure = {}, .x = 0.004, .steps = 80});
  CHECK(refusal("[[movements]]\nsupport = \"top\"\n") ==
        "b.toml:2: support in [[movements]]: is 'top': expected pressure_Pa, x_m or y_m beside it");
  CHECK(refusal("[[movements]]\nsupport = \"top\"\npressure_Pa = 1\nx_m = 1\n") ==
        "b.toml:4: x_m in [[movements]]: is 1: expected either pressure_Pa or a way x_m, y_m");
}

TEST_CASE("Mortar that states no stiffness leaves a joint that of its region (the file's numbers)",
          "[mortar][regions]") {
  const std::string soft =
      "[[regions]]\nof = [\"ring\"]\nnormal_stiffness_Pa_per_m = 1e8\ntangential_stiffness_Pa_per_m = 1e7\n";
  const std::string tough =
      "[[mortar]]\ntensile_strength_Pa = 1e5\nopening_energy_J_m2 = 100\ncohesion_Pa = 1e5\n"
      "slip_energy_J_m2 = 2000\n";
  const std::string dry = "[[mortar]]\ndry = true\n";
  const std::string stiff = "[[mortar]]\ndry = true\nnormal_stiffness_Pa_per_m = 5e9\n";
  const auto normal_stiffness = [&](const std::string& mortar, BlockRole role) {
    const Model model = make_model(description_of(soft + mortar));
    std::set<double> found;
    for (std::size_t j = 0; j < model.joints.size(); ++j)
      if (between(model, model.joints[j], role, role))
        found.insert(model.parameters.joints[j].normal_stiffness);
    return found;
  };
  for (const std::string& mortar : {std::string(), tough, dry, tough + dry, stiff + tough}) {
    INFO(mortar);
    CHECK(normal_stiffness(mortar, BlockRole::ring) == std::set<double>{1e8});
    CHECK(normal_stiffness(mortar, BlockRole::wall) == std::set<double>{1e9});
  }
  CHECK(normal_stiffness(tough + stiff, BlockRole::ring) == std::set<double>{5e9});  // the last one counts
}

TEST_CASE("Mortar that would break by itself on a region's soft joints is refused by these (by hand)",
          "[mortar][regions]") {
  const std::string soft = "[[regions]]\nof = [\"0,3\"]\ntangential_stiffness_Pa_per_m = 1e7\n";
  const std::string weak =
      "[[mortar]]\ntensile_strength_Pa = 0.05e6\nopening_energy_J_m2 = 18\ncohesion_Pa = 0.1e6\n"
      "slip_energy_J_m2 = 125\n";
  CHECK(refusal(weak).empty());
  CHECK_THAT(
      refusal(soft + weak),
      Catch::Contains("slip_energy_J_m2 in [[mortar]], of the joint between '0,2' and '0,3") &&
          Catch::Contains("': is 125: expected more than c^2 / p_t = 1000: the joint would break at once"));
  // Nor is it refused where no joint is as soft as [joints] says.
  CHECK(refusal("[joints]\ntangential_stiffness_Pa_per_m = 1e7\n[[regions]]\nof = [\"ring\", \"wall\"]\n"
                "tangential_stiffness_Pa_per_m = 1e8\n" +
                weak)
            .empty());
}
