/// @file The picture of a bridge file. Oracle: counts of the bridge's own parts.

#include "generator/bridge_drawing.h"

#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "core/bridge_file/bridge_file.h"
#include "tests/support/bridges.h"

using namespace voussoir;

namespace {

int count(const std::string& text, const std::string& piece) {
  int found = 0;
  for (std::size_t at = text.find(piece); at != std::string::npos; at = text.find(piece, at + 1)) ++found;
  return found;
}

}  // namespace

TEST_CASE("A drawing shows every block, control point, support, joint and load of a bridge", "[drawing]") {
  const BridgeDescription description = read_bridge_file(test::example_bridge("load-test")).description;
  const Model bridge = make_model(description);
  const std::string picture = bridge_drawing(bridge, description);
  CHECK(count(picture, "<svg") == 1);
  CHECK(count(picture, "</svg>") == 1);
  CHECK(count(picture, "<path class=\"wall\"") == bridge.layout.count_with(BlockRole::wall));
  CHECK(count(picture, "<path class=\"ring\"") == bridge.layout.count_with(BlockRole::ring));
  CHECK(count(picture, "<circle class=\"point\"") == static_cast<int>(bridge.control_points.size()));
  std::size_t held = 0;
  for (const Support& support : bridge.supports) held += support.nodes.size();
  CHECK(count(picture, "class=\"support\"") + count(picture, "class=\"roller\"") == static_cast<int>(held));
  const std::size_t joints = picture.find("<path class=\"joint\"");
  REQUIRE(joints != std::string::npos);
  const std::string line = picture.substr(joints, picture.find('\n', joints) - joints);
  CHECK(count(line, "M") == static_cast<int>(bridge.joints.size()));
  CHECK(count(picture, "class=\"load\"") == static_cast<int>(description.loads.size()));
  CHECK(count(picture, "points that are read") == 1);
  CHECK(count(picture, "loads, vehicles at their first place") == 1);
  CHECK(count(picture, "class=\"swatch wall\"") == 1);
  CHECK(count(picture, "class=\"swatch ring\"") == 1);
  CHECK(count(picture, "class=\"swatch pier\"") == 0);
}

TEST_CASE(
    "Loads say what acts on their width and what the model carries of it (forces as the file states them)",
    "[drawing]") {
  const BridgeDescription description = read_bridge_file(test::example_bridge("load-test")).description;
  const std::string picture = bridge_drawing(make_model(description), description);
  REQUIRE(description.material.thickness == 1.0);
  CHECK(count(picture, ">truck@1: 160 kN over 3 m, 53.3 kN of it on the model's 1 m</text>") == 1);
  CHECK(count(picture, ">crowd: 300 kN over 3 m, 100 kN of it on the model's 1 m</text>") == 1);
  CHECK(count(picture, ">60 kN</text>") == 1);  // the axles
  CHECK(count(picture, ">100 kN</text>") == 1);
}

TEST_CASE("Sensors of the bridge file stand in the drawing by name and are no control points", "[drawing]") {
  BridgeDescription description = test::small_description();
  SensorDescription sensor;
  sensor.name = "TILT-NW1";
  sensor.quantity = Quantity::tilt;
  sensor.block = "4,2";
  description.sensors = {sensor};
  const Model bridge = make_model(description);
  const std::string picture = bridge_drawing(bridge, description);
  CHECK(count(picture, ">TILT-NW1</text>") == 1);
  CHECK(count(picture, fmt::format("{} control points, 1 sensor;", bridge.control_points.size() - 1)) == 2);
}

TEST_CASE("Numbers along a small bridge stand a whole or half metre apart, not a tenth", "[drawing]") {
  // Oracle: 6 m over 1100 px. Numbers that stand 0.1 m apart are 18 px from each other.
  const BridgeDescription description = test::small_description();
  const std::string picture = bridge_drawing(make_model(description), description);
  CHECK(count(picture, ">0.1</text>") == 0);
  CHECK(count(picture, ">0.5</text>") == 2);  // along x and y
  CHECK(count(picture, ">x [m]</text>") == 1);
}

TEST_CASE("A drawing follows a dark page and a narrow one", "[drawing]") {
  const BridgeDescription description = test::small_description();
  const std::string picture = bridge_drawing(make_model(description), description);
  CHECK(count(picture, "prefers-color-scheme:dark") == 1);
  CHECK(count(picture, "style=\"max-width:100%;height:auto\"") == 1);
}

TEST_CASE("What a name holds cannot end the picture's markup", "[drawing]") {
  BridgeDescription description = test::small_description();
  description.name = "</text><script>\"&";
  const std::string picture = bridge_drawing(make_model(description), description);
  CHECK(count(picture, "<script") == 0);
  CHECK(count(picture, "&lt;/text&gt;&lt;script&gt;&quot;&amp;") == 2);
}

TEST_CASE("A drawing shows soil that only weighs, as high as its surface (written out)", "[drawing]") {
  BridgeDescription description = test::small_description();
  const auto height = [](const std::string& picture) {
    const std::size_t at = picture.find("height=\"") + 8;
    return std::stod(picture.substr(at));
  };
  const std::string bare = bridge_drawing(make_model(description), description);
  CHECK(count(bare, "class=\"soil\"") == 0);
  const Model model = make_model(description);
  const double left = model.mesh.nodes.row(0).minCoeff(), right = model.mesh.nodes.row(0).maxCoeff();
  const double top = model.mesh.nodes.row(1).maxCoeff(), scale = 1100.0 / (right - left);
  description.fill = {20e3, {{left, top + 0.5}, {right, top + 0.5}}};
  const std::string covered = bridge_drawing(make_model(description), description);
  CHECK(count(covered, "class=\"soil\"") == 1);
  CHECK(count(covered, "20 kN/m3") == 1);
  CHECK(height(covered) == Approx(height(bare) + 0.5 * scale).margin(1.0));
}
