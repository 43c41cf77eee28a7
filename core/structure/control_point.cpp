#include "core/structure/control_point.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace voussoir {
namespace {

constexpr double kOnTop = 1e-9;  ///< [m]

NodeId node_at(const Mesh& mesh, BlockId block, const Point& place) {
  const IndexRange range = mesh.block_nodes[static_cast<std::size_t>(value(block))];
  int nearest = range.begin;
  for (int node = range.begin; node < range.end; ++node)
    if ((mesh.nodes.col(node) - place).norm() < (mesh.nodes.col(nearest) - place).norm()) nearest = node;
  return NodeId{nearest};
}

/// The two ends of the block's upper edge, left to right.
std::pair<Point, Point> upper_corners(const Polygon& polygon) {
  const double top = std::max_element(polygon.begin(), polygon.end(), [](const Point& a, const Point& b) {
                       return a.y() < b.y();
                     })->y();
  Polygon upper;
  for (const Point& p : polygon)
    if (p.y() > top - kOnTop) upper.push_back(p);
  const auto [left, right] = std::minmax_element(
      upper.begin(), upper.end(), [](const Point& a, const Point& b) { return a.x() < b.x(); });
  return {*left, *right};
}

}  // namespace

ControlPoint point_at(const std::string& name, const Mesh& mesh, BlockId block, const Point& place) {
  return {.name = name, .node = node_at(mesh, block, place), .block = block, .position = place};
}

std::vector<ControlPoint> find_control_points(const BlockLayout& layout, const Mesh& mesh,
                                              const BridgeDescription& description) {
  std::vector<ControlPoint> points;
  const auto add_pair = [&](char family, int& count, BlockId id, const std::pair<Point, Point>& corners) {
    points.push_back(point_at(fmt::format("{}{}", family, ++count), mesh, id, corners.first));
    points.push_back(point_at(fmt::format("{}{}", family, ++count), mesh, id, corners.second));
  };
  int top_count = 0;
  int arch_count = 0;
  for (int pass = 0; pass < 2; ++pass)
    for (std::size_t b = 0; b < layout.size(); ++b) {
      const Block& block = layout.blocks[b];
      const BlockId id{static_cast<std::int32_t>(b)};
      if (pass == 0 && description.control_points.top && block.top_course)
        add_pair('T', top_count, id, upper_corners(block.polygon));
      if (pass == 1 && description.control_points.arch && block.intrados)
        add_pair('A', arch_count, id, {block.intrados->front(), block.intrados->back()});
    }
  return points;
}

Eigen::VectorXd vertical_displacements(const Field& field, const std::vector<ControlPoint>& points) {
  Eigen::VectorXd displacements(static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    displacements[static_cast<Eigen::Index>(i)] = field(1, value(points[i].node));
  return displacements;
}

}  // namespace voussoir
