#include "core/bridge_file/bridge_file.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cctype>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.h"
#include "tests/support/bridges.h"
#include "tests/support/refusal.h"

using namespace voussoir;
using Catch::Matchers::Contains;

namespace {

std::vector<double> numbers_of(const Uncertainty& u) {
  return {u.joint_stiffness,  u.regional_stiffness, u.common_stiffness, u.stiffness_ratio,
          u.friction,         u.young_modulus,      u.density,          u.temperature,
          u.foot_movement,    u.foot_rotation,      u.side_movement,    u.epoch_stiffness,
          u.epoch_unevenness, u.uneven_temperature};
}

/// All numbers of a description, in the order in which the header names them.
std::vector<double> numbers_of(const BridgeDescription& d) {
  std::vector<double> numbers = {d.wall.length,
                                 double(d.wall.courses),
                                 d.wall.course_height,
                                 d.wall.block_length,
                                 double(d.wall.bond),
                                 d.wall.smallest_piece,
                                 d.wall.smallest_block,
                                 d.material.young_modulus,
                                 d.material.poisson_ratio,
                                 d.material.density,
                                 d.material.thickness,
                                 double(d.material.plane),
                                 d.joints.normal_stiffness,
                                 d.joints.tangential_stiffness,
                                 d.joints.friction_angle,
                                 double(d.supports.base),
                                 double(d.supports.sides),
                                 double(d.control_points.top),
                                 double(d.control_points.arch),
                                 double(d.mesh.refinement),
                                 double(d.mesh.split_at_corners),
                                 d.gravity,
                                 d.joint_tolerance,
                                 d.material.thermal_expansion,
                                 double(d.control_points.face)};
  const std::vector<double> uncertain = numbers_of(d.uncertainty);
  numbers.insert(numbers.end(), uncertain.begin(), uncertain.end());
  numbers.push_back(double(d.collapse_fields));
  for (const SpanDescription& span : d.spans)
    numbers.insert(numbers.end(), {span.centre_x, span.centre_y, span.intrados_radius, span.ring_thickness,
                                   double(span.voussoirs)});
  return numbers;
}

}  // namespace

TEST_CASE(
    "The reference bridge file says what the defaults say, and so does an empty file but for small pieces "
    "and fields of what falls",
    "[bridge-file]") {
  BridgeDescription expected;
  for (const auto& [file, smallest_block, fields] :
       {std::tuple(reference_bridge_file().description, 0.0, true),
        std::tuple(parse_bridge_file("", "empty.toml").description, 0.1, false)}) {
    expected.wall.smallest_block = smallest_block;
    expected.collapse_fields = fields;
    CHECK(file.name == expected.name);
    CHECK(numbers_of(file) == numbers_of(expected));
  }
}

namespace {

struct Key {
  const char* text;
  std::size_t place;  ///< in numbers_of
  double expected;
};

const std::vector<Key> kKeys = {{"[wall]\nlength_m = 30.0", 0, 30.0},
                                {"[wall]\ncourses = 14", 1, 14.0},
                                {"[wall]\ncourse_height_m = 0.6", 2, 0.6},
                                {"[wall]\nblock_length_m = 0.8", 3, 0.8},
                                {"[wall]\nbond = \"stack\"", 4, double(Bond::stack)},
                                {"[wall]\nsmallest_piece_m2 = 1e-4", 5, 1e-4},
                                {"[wall]\nsmallest_block = 0.2", 6, 0.2},
                                {"[material]\nyoung_modulus_Pa = 1e10", 7, 1e10},
                                {"[material]\npoisson_ratio = 0.3", 8, 0.3},
                                {"[material]\ndensity_kg_m3 = 2000", 9, 2000.0},
                                {"[material]\nthickness_m = 2.5", 10, 2.5},
                                {"[material]\nplane = \"strain\"", 11, double(PlaneState::strain)},
                                {"[joints]\nnormal_stiffness_Pa_per_m = 2e9", 12, 2e9},
                                {"[joints]\ntangential_stiffness_Pa_per_m = 2e8", 13, 2e8},
                                {"[joints]\nfriction_angle_deg = 30", 14, std::numbers::pi / 6.0},
                                {"[supports]\nbase = \"roller\"", 15, double(SupportKind::roller)},
                                {"[supports]\nsides = \"free\"", 16, double(SupportKind::free)},
                                {"[control_points]\ntop = false", 17, 0.0},
                                {"[control_points]\narch = false", 18, 0.0},
                                {"[mesh]\nrefinement = 2", 19, 2.0},
                                {"[mesh]\nsplit_at_corners = false", 20, 0.0},
                                {"gravity_m_s2 = 1.62", 21, 1.62},
                                {"[joints]\ntolerance_m = 1e-4", 22, 1e-4},
                                {"[material]\nthermal_expansion_per_K = 1e-5", 23, 1e-5},
                                {"[control_points]\nface = true", 24, 1.0},
                                {"[uncertainty]\njoint_stiffness_cv = 0.1", 25, 0.1},
                                {"[uncertainty]\nregional_stiffness_cv = 0.12", 26, 0.12},
                                {"[uncertainty]\ncommon_stiffness_cv = 0.15", 27, 0.15},
                                {"[uncertainty]\nstiffness_ratio_cv = 0.35", 28, 0.35},
                                {"[uncertainty]\nfriction_cv = 0.12", 29, 0.12},
                                {"[uncertainty]\nyoung_modulus_cv = 0.2", 30, 0.2},
                                {"[uncertainty]\ndensity_cv = 0.0", 31, 0.0},
                                {"[uncertainty]\ntemperature_K = 15", 32, 15.0},
                                {"[uncertainty]\nfoot_movement_m = 0.002", 33, 2e-3},
                                {"[uncertainty]\nfoot_rotation_rad = 2e-4", 34, 2e-4},
                                {"[uncertainty]\nside_movement_m = 1e-3", 35, 1e-3},
                                {"[uncertainty]\nepoch_stiffness_cv = 0.02", 36, 0.02},
                                {"[uncertainty]\nepoch_unevenness_cv = 0.06", 37, 0.06},
                                {"[uncertainty]\nuneven_temperature_K = 1.5", 38, 1.5},
                                {"collapses = \"field\"", 39, 1.0},
                                {"[[spans]]\ncentre_x_m = 9.0", 40, 9.0},
                                {"[[spans]]\ncentre_y_m = 1.5", 41, 1.5},
                                {"[[spans]]\nintrados_radius_m = 3.0", 42, 3.0},
                                {"[[spans]]\nring_thickness_m = 0.4", 43, 0.4},
                                {"[[spans]]\nvoussoirs = 21", 44, 21.0}};

}  // namespace

TEST_CASE("Every key of a bridge file sets its own value, in the unit of its name (written out)",
          "[bridge-file]") {
  std::vector<double> defaults = numbers_of(parse_bridge_file("", "empty.toml").description);
  REQUIRE(kKeys.size() == defaults.size());
  for (const Key& key : kKeys) {
    const std::vector<double> found = numbers_of(parse_bridge_file(key.text, "one-key.toml").description);
    std::vector<double> expected = defaults;
    REQUIRE(expected[key.place] != key.expected);
    expected[key.place] = key.expected;
    INFO(key.text);
    REQUIRE(found.size() == expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i)
      CHECK(found[i] == Approx(expected[i]).epsilon(1e-15).margin(0.0));
  }
  CHECK(parse_bridge_file("name = \"mine\"", "name.toml").description.name == "mine");
}

TEST_CASE("Every example bridge makes a symmetric bridge with control points", "[bridge-file]") {
  for (const char* name : {"reference", "small", "two-span", "load-test"}) {
    const Model bridge = make_model(read_bridge_file(test::example_bridge(name)).description);
    INFO(name);
    CHECK(bridge.symmetry.has_value());
    CHECK(bridge.control_points.size() > 30);
  }
}

TEST_CASE("Example bridges from the literature take at most thirty lines (counted)", "[bridge-file]") {
  for (const char* name :
       {"prestwood", "preston", "torksey", "shinafoot", "pointed", "two-ring", "viaduct"}) {
    const BridgeFile file = read_bridge_file(test::example_bridge(name));
    INFO(name);
    CHECK(std::ranges::count(file.text, '\n') <= 30);
    CHECK(make_model(file.description).symmetry.has_value());
  }
}

TEST_CASE("Bad bridge files are refused with file, line and what was expected", "[bridge-file]") {
  const auto message = [](const std::string& text) {
    return test::refusal_of([&] { make_model(parse_bridge_file(text, "b.toml").description); });
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
  const std::string known =
      "[uncertainty]\njoint_stiffness_cv = 0\nregional_stiffness_cv = 0\ncommon_stiffness_cv = "
      "0\nstiffness_ratio_cv = 0\nfriction_cv = "
      "0\nyoung_modulus_cv = 0\ndensity_cv = 0\ntemperature_K = 0\nfoot_movement_m = 0\nfoot_rotation_rad = "
      "0\nside_movement_m = 0\nepoch_stiffness_cv = 0\n";
  CHECK_THAT(message(known + "epoch_unevenness_cv = 0.01\n"),
             Contains("b.toml:14:") && Contains("expected 0, as all else is known exactly"));
  CHECK_THAT(message(known + "uneven_temperature_K = 1\n"), Contains("b.toml:14:") && Contains("expected 0"));
  CHECK_FALSE(is_uncertain(parse_bridge_file(known, "b.toml").description.uncertainty));
  CHECK_THAT(message("= 3"), Contains("b.toml:1:"));
}

TEST_CASE("Blocks that are given count as those that are laid do, and names have a limit", "[bridge-file]") {
  std::string blocks = "blocks = [\n";
  for (int i = 0; i < 400; ++i)
    blocks +=
        fmt::format("{{label = \"{0}\", vertices = [[{0}, 0], [{1}, 0], [{1}, 1], [{0}, 1]]}},\n", i, i + 1);
  blocks += "]\n[mesh]\nrefinement = ";
  CHECK_NOTHROW(parse_bridge_file(blocks + "4\n", "b.toml"));
  CHECK_THROWS_WITH(parse_bridge_file(blocks + "5\n", "b.toml"),
                    "b.toml:1: 400 blocks are too many for a refinement of 5: expected at most 293");
  CHECK_NOTHROW(parse_bridge_file("name = \"" + std::string(200, 'n') + "\"\n", "b.toml"));
  CHECK_THROWS_WITH(parse_bridge_file("name = \"" + std::string(201, 'n') + "\"\n", "b.toml"),
                    "b.toml:1: name: has 201 bytes: expected at most 200");
}

TEST_CASE("A missing bridge file is named", "[bridge-file]") {
  CHECK_THROWS_WITH(read_bridge_file("/nowhere/bridge.toml"), Contains("/nowhere/bridge.toml"));
}

namespace {

/// What a number may be. `most` is always allowed.
struct Limits {
  const char* key;  ///< a bridge file up to the number
  double least, most;
  bool least_allowed;
  bool whole = false;
};

const std::vector<Limits> kLimits = {{"[wall]\nlength_m = ", 1e-3, 1e5, true},
                                     {"[wall]\ncourses = ", 0.0, 1000.0, true, true},
                                     {"[wall]\ncourse_height_m = ", 1e-3, 1e5, true},
                                     {"[wall]\nblock_length_m = ", 1e-3, 1e5, true},
                                     {"[wall]\nsmallest_piece_m2 = ", 0.0, 1e15, false},
                                     {"[wall]\nsmallest_block = ", 0.0, 0.5, true},
                                     {"[material]\nyoung_modulus_Pa = ", 0.0, 1e15, false},
                                     {"[material]\npoisson_ratio = ", 0.0, 0.49, true},
                                     {"[material]\ndensity_kg_m3 = ", 0.0, 1e15, false},
                                     {"[material]\nthickness_m = ", 0.0, 1e15, false},
                                     {"[joints]\nnormal_stiffness_Pa_per_m = ", 0.0, 1e15, false},
                                     {"[joints]\ntangential_stiffness_Pa_per_m = ", 0.0, 1e15, false},
                                     {"[joints]\nfriction_angle_deg = ", 0.0, 89.0, true},
                                     {"[joints]\ntolerance_m = ", 0.0, 0.1, false},
                                     {"[mesh]\nrefinement = ", 0.0, 5.0, true, true},
                                     {"gravity_m_s2 = ", 0.0, 1e15, true},
                                     {"[[spans]]\ncentre_x_m = ", -1e5, 1e5, true},
                                     {"[[spans]]\ncentre_y_m = ", 0.0, 1e5, true},
                                     {"[[spans]]\nintrados_radius_m = ", 1e-3, 1e5, true},
                                     {"[[spans]]\nring_thickness_m = ", 1e-3, 1e5, true},
                                     {"[[spans]]\nvoussoirs = ", 3.0, 1000.0, true, true},
                                     {"[material]\nthermal_expansion_per_K = ", 0.0, 1e-3, true},
                                     {"[uncertainty]\njoint_stiffness_cv = ", 0.0, 1.0, true},
                                     {"[uncertainty]\nregional_stiffness_cv = ", 0.0, 1.0, true},
                                     {"[uncertainty]\ncommon_stiffness_cv = ", 0.0, 1.0, true},
                                     {"[uncertainty]\nstiffness_ratio_cv = ", 0.0, 1.0, true},
                                     {"[uncertainty]\nfriction_cv = ", 0.0, 1.0, true},
                                     {"[uncertainty]\nyoung_modulus_cv = ", 0.0, 1.0, true},
                                     {"[uncertainty]\ndensity_cv = ", 0.0, 1.0, true},
                                     {"[uncertainty]\ntemperature_K = ", 0.0, 100.0, true},
                                     {"[uncertainty]\nfoot_movement_m = ", 0.0, 1.0, true},
                                     {"[uncertainty]\nfoot_rotation_rad = ", 0.0, 0.1, true},
                                     {"[uncertainty]\nside_movement_m = ", 0.0, 1.0, true},
                                     {"[uncertainty]\nepoch_stiffness_cv = ", 0.0, 1.0, true},
                                     {"[uncertainty]\nepoch_unevenness_cv = ", 0.0, 1.0, true},
                                     {"[uncertainty]\nuneven_temperature_K = ", 0.0, 100.0, true}};

/// Does the key take this value? The bridge may still be refused for a ring that its wall cannot hold or for
/// too many blocks, which are other checks.
bool is_within_limits(const Limits& limits, double number) {
  try {
    parse_bridge_file(fmt::format("{}{}\n", limits.key, number), "limits.toml");
  } catch (const InputError& error) {
    const std::string message = error.what();
    if (message.find(fmt::format(" is {}: expected a", number)) != std::string::npos) return false;
    CHECK_THAT(message, Contains("the ring reaches") || Contains(" blocks"));
  }
  return true;
}

/// The next number that a file can state, towards `side` of infinity.
double next_number(const Limits& limits, double number, double side) {
  if (limits.whole) return number + side;
  if (number == 0.0) return side * std::numeric_limits<double>::min();
  return std::nextafter(number, side * std::numeric_limits<double>::infinity());
}

}  // namespace

TEST_CASE("Numbers at their limits are taken or refused as the table says, those just beyond are refused",
          "[bridge-file]") {
  const auto is_number = [](const Key& key) { return std::isdigit(std::string(key.text).back()) != 0; };
  REQUIRE(static_cast<std::size_t>(std::count_if(kKeys.begin(), kKeys.end(), is_number)) == kLimits.size());
  for (const Limits& limits : kLimits) {
    INFO(limits.key);
    CHECK(is_within_limits(limits, limits.least) == limits.least_allowed);
    CHECK(is_within_limits(limits, next_number(limits, limits.least, 1.0)));
    CHECK_FALSE(is_within_limits(limits, next_number(limits, limits.least, -1.0)));
    CHECK(is_within_limits(limits, limits.most));
    CHECK_FALSE(is_within_limits(limits, next_number(limits, limits.most, 1.0)));
  }
}
