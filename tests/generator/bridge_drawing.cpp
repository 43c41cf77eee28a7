/// @file The picture of a bridge file. Oracle: counts of the bridge's own parts.

#include "generator/bridge_drawing.h"

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
  CHECK(count(picture, "sensors") == 1);
  CHECK(count(picture, "loads on the bridge's thickness") == 1);
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
