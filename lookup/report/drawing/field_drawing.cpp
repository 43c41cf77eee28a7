#include "lookup/report/drawing/field_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/units.h"
#include "lookup/report/drawing/axis.h"
#include "lookup/report/drawing/bridge_drawing.h"
#include "lookup/report/drawing/colour_map.h"

namespace voussoir {
namespace {

constexpr double kLargestDrawn = 0.02;  // of the bridge's length

/// Settlement [m], which colours measure: zero at the highest node, growing downwards.
struct SettlementRange {
  double highest = -std::numeric_limits<double>::infinity();  ///< u_y [m]
  double lowest = std::numeric_limits<double>::infinity();

  double share(double uy) const { return highest > lowest ? (highest - uy) / (highest - lowest) : 0.0; }
};

SettlementRange range_of(const Field& field) {
  SettlementRange range;
  for (Eigen::Index node = 0; node < field.cols(); ++node) {
    if (std::isnan(field(1, node))) continue;
    range.highest = std::max(range.highest, field(1, node));
    range.lowest = std::min(range.lowest, field(1, node));
  }
  return range;
}

/// A place in the frame and the share that its colour stands for.
struct Shade {
  Point at;
  double share = 0.0;
};

/// The part of a convex polygon where side * (share - limit) >= 0 (Sutherland and Hodgman's clipping).
std::vector<Shade> clipped(const std::vector<Shade>& polygon, double limit, double side) {
  std::vector<Shade> result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Shade& a = polygon[i];
    const Shade& b = polygon[(i + 1) % polygon.size()];
    const double from = side * (a.share - limit);
    const double to = side * (b.share - limit);
    if (from >= 0.0) result.push_back(a);
    if ((from < 0.0) != (to < 0.0) && from != 0.0 && to != 0.0) {
      const double part = from / (from - to);
      result.push_back({a.at + part * (b.at - a.at), limit});
    }
  }
  return result;
}

/// The data of one path for each colour level.
using Bands = std::array<std::string, kColourLevels>;

/// Adds the parts of a triangle within each level.
void add_triangle(const std::array<Shade, 3>& triangle, Bands& bands) {
  const auto [low, high] = std::minmax_element(
      triangle.begin(), triangle.end(), [](const Shade& a, const Shade& b) { return a.share < b.share; });
  const int last = colour_level(high->share);
  for (int level = colour_level(low->share); level <= last; ++level) {
    std::vector<Shade> part(triangle.begin(), triangle.end());
    if (level > 0) part = clipped(part, static_cast<double>(level) / kColourLevels, 1.0);
    if (level < kColourLevels - 1) part = clipped(part, static_cast<double>(level + 1) / kColourLevels, -1.0);
    std::vector<Point> outline;
    for (const Shade& corner : part) outline.push_back(corner.at);
    if (outline.size() >= 3) bands.at(static_cast<std::size_t>(level)) += closed_path(outline);
  }
}

/// The picture's parts share these.
class FieldPainter {
 public:
  FieldPainter(const FieldPicture& picture, double factor)
      : picture_(picture),
        frame_(frame_of(picture.layout, picture.width, picture.heading.empty() ? 0.2 : kHeadingHeight, 0.15)),
        factor_(factor),
        range_(range_of(picture.field)) {}

  Drawing draw() const {
    const double height = frame_.height + kColourBarHeight;
    std::string elements = ground_element(picture_.layout, frame_) + bands();
    for (std::size_t block = 0; block < picture_.layout.size(); ++block) elements += outline(block);
    if (!picture_.heading.empty())
      elements += text_element({0.5 * frame_.width, 17.0}, "middle", "strong", heading());
    elements += colour_bar({"vertical displacement [mm]", marks()}, frame_.width, height);
    return {frame_.width, height, "Deformed bridge, coloured by vertical displacement", elements};
  }

 private:
  std::string heading() const {
    return factor_ == 1.0
               ? picture_.heading + "; displacements drawn as they are"
               : fmt::format("{}; displacements drawn {:g} times larger", picture_.heading, factor_);
  }

  Point moved(int node) const {
    return frame_(picture_.mesh.nodes.col(node) + factor_ * picture_.field.col(node));
  }

  bool lacks(std::size_t block) const {
    return picture_.scene.lacks(BlockId{static_cast<std::int32_t>(block)});
  }

  std::string bands() const {
    Bands bands;
    for (std::size_t block = 0; block < picture_.layout.size(); ++block) {
      if (lacks(block)) continue;
      const IndexRange triangles = picture_.mesh.block_triangles[block];
      for (int t = triangles.begin; t < triangles.end; ++t) add_triangle(shaded(t), bands);
    }
    std::string elements;
    for (int level = 0; level < kColourLevels; ++level)
      elements += path_element(fmt::format("m{}", level), bands.at(static_cast<std::size_t>(level)));
    return elements;
  }

  std::array<Shade, 3> shaded(int triangle) const {
    std::array<Shade, 3> corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const int node = value(picture_.mesh.triangles[static_cast<std::size_t>(triangle)].nodes.at(i));
      corners.at(i) = {moved(node), range_.share(picture_.field(1, node))};
    }
    return corners;
  }

  std::string outline(std::size_t block) const {
    const Block& shape = picture_.layout.blocks[block];
    if (lacks(block))
      return path_element("gone", closed_path(placed(shape.polygon, frame_)),
                          fmt::format("({}) is missing", shape.label));
    std::vector<Point> points;
    const IndexRange edges = picture_.mesh.block_edges[block];
    for (int e = edges.begin; e < edges.end; ++e)
      points.push_back(moved(value(picture_.mesh.edges[static_cast<std::size_t>(e)].from)));
    return path_element("outline", closed_path(points), tip(block));
  }

  std::string tip(std::size_t block) const {
    const IndexRange nodes = picture_.mesh.block_nodes[block];
    const auto uy = picture_.field.row(1).segment(nodes.begin, nodes.size());
    return fmt::format("({})\nuy {:.3f} to {:.3f} mm", picture_.layout.blocks[block].label,
                       kMillimetres * uy.maxCoeff(), kMillimetres * uy.minCoeff());
  }

  std::vector<BarMark> marks() const {
    return round_marks(kMillimetres * range_.highest, kMillimetres * range_.lowest);
  }

  const FieldPicture& picture_;
  BridgeFrame frame_;
  double factor_;
  SettlementRange range_;
};

/// How many times displacements are drawn larger than they are: 1, 2, 5, 10.. such that the largest is at
/// most a fiftieth of the bridge's length; 1 if it is more.
double exaggeration(const Mesh& mesh, const Field& field) {
  double largest = 0.0;
  for (Eigen::Index node = 0; node < field.cols(); ++node)
    if (!std::isnan(field(0, node))) largest = std::max(largest, field.col(node).norm());
  if (largest == 0.0) return 1.0;
  const double length = mesh.nodes.row(0).maxCoeff() - mesh.nodes.row(0).minCoeff();
  const double most = kLargestDrawn * length / largest;
  return most < 1.0 ? 1.0 : round_below(most);
}

}  // namespace

Drawing draw_field(const FieldPicture& picture) {
  return FieldPainter(picture, exaggeration(picture.mesh, picture.field)).draw();
}

}  // namespace voussoir
