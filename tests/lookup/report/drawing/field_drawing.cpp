#include "lookup/report/drawing/field_drawing.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <regex>

#include "lookup/report/drawing/bridge_drawing.h"
#include "lookup/report/drawing/colour_map.h"
#include "tests/support/bridges.h"

using namespace voussoir;

namespace {

/// Wide, so that a tenth of a unit, to which places are written, is little.
constexpr double kWidth = 1e5;
constexpr double kWritten = 0.05;  ///< largest error of a written coordinate [units]

/// A bridge without one of its blocks, stretched evenly: u = (a x, b y).
struct StretchedBridge {
  static constexpr double kAlong = 0.05;  ///< beyond a fiftieth of the length: drawn as large as it is
  static constexpr double kUp = -0.2;

  Model bridge = test::small_bridge();
  Scene scene = parse_scene("4,2", bridge.layout);

  Drawing draw() const {
    Field field = Eigen::Vector2d(kAlong, kUp).asDiagonal() * bridge.mesh.nodes;
    const IndexRange gone = bridge.mesh.block_nodes[static_cast<std::size_t>(value(scene.removed[0]))];
    field.middleCols(gone.begin, gone.size()).setConstant(std::nan(""));
    return draw_field({bridge.layout, bridge.mesh, scene, field, "", kWidth});
  }
};

/// The outlines that are drawn in the colour of a level [units].
std::vector<Polygon> drawn_in(int level, const std::string& elements) {
  const std::regex path("<path class=\"m" + std::to_string(level) + "\" d=\"([^\"]*)\"");
  std::smatch found;
  REQUIRE(std::regex_search(elements, found, path));
  const std::string data = found[1];
  const std::regex corner("([ML])([-0-9.]+) ([-0-9.]+)");
  std::vector<Polygon> outlines;
  for (std::sregex_iterator at(data.begin(), data.end(), corner), none; at != none; ++at) {
    if ((*at)[1] == "M") outlines.emplace_back();
    outlines.back().emplace_back(std::stod((*at)[2]), std::stod((*at)[3]));
  }
  return outlines;
}

double perimeter(const Polygon& polygon) {
  double sum = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    sum += (polygon[(i + 1) % polygon.size()] - polygon[i]).norm();
  return sum;
}

}  // namespace

TEST_CASE("The pieces of all colours cover the blocks that are there, once (areas of an even stretch)") {
  const StretchedBridge stretched;
  const Drawing drawing = stretched.draw();
  double drawn = 0.0;
  for (int level = 0; level < kColourLevels; ++level)
    for (const Polygon& piece : drawn_in(level, drawing.elements)) drawn -= area(piece);  // y downwards
  double blocks = 0.0, edges = 0.0;
  for (std::size_t i = 0; i < stretched.bridge.layout.size(); ++i) {
    if (stretched.scene.lacks(BlockId{static_cast<std::int32_t>(i)})) continue;
    blocks += area(stretched.bridge.layout.blocks[i].polygon);
    edges += perimeter(stretched.bridge.layout.blocks[i].polygon);
  }
  const double scale = frame_of(stretched.bridge.layout, kWidth, 0.0, 0.0).scale;
  const double exact = scale * scale * (1.0 + stretched.kAlong) * (1.0 + stretched.kUp) * blocks;
  // Pieces share their inner corners, so only the rounding of corners on the blocks' edges changes the sum.
  const double most = 2.0 * kWritten * scale * (1.0 + stretched.kAlong) * edges;
  CHECK(most < 1e-3 * exact);
  CHECK(drawn == Approx(exact).margin(most).epsilon(0.0));
}

TEST_CASE("Every colour stays between the settlements of its level (bands of an even stretch are level)") {
  const StretchedBridge stretched;
  const Drawing drawing = stretched.draw();
  const double scale = frame_of(stretched.bridge.layout, kWidth, 0.0, 0.0).scale;
  const double height = stretched.bridge.mesh.nodes.row(1).maxCoeff();
  const double band = scale * (1.0 + stretched.kUp) * height / kColourLevels;
  double ground = 0.0;  // y of the lowest corner, where nothing settles
  for (const Polygon& piece : drawn_in(0, drawing.elements))
    for (const Point& corner : piece) ground = std::max(ground, corner.y());
  for (int level = 0; level < kColourLevels; ++level) {
    INFO("level " << level);
    const std::vector<Polygon> pieces = drawn_in(level, drawing.elements);
    CHECK_FALSE(pieces.empty());
    for (const Polygon& piece : pieces)
      for (const Point& corner : piece) {
        REQUIRE(ground - corner.y() >= level * band - 2.0 * kWritten);
        REQUIRE(ground - corner.y() <= (level + 1) * band + 2.0 * kWritten);
      }
  }
}
