#include "core/structure/mesh.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/box.h"
#include "core/geometry/triangulation.h"

namespace voussoir {
namespace {

constexpr double kOnAxis = 1e-9;    ///< [m] a centre of gravity this close to the axis lies on it
constexpr double kTouching = 1e-6;  ///< [m] a corner this close to an edge touches it

/// Corners of other blocks that touch the block's boundary away from its own corners.
std::vector<Point> touching_corners(const Polygon& polygon, const std::vector<Block>& blocks) {
  const Box box = box_of(polygon);
  const auto is_far = [&](const Point& p) { return box.squaredExteriorDistance(p) > kTouching * kTouching; };
  std::vector<Point> touching;
  for (const Block& block : blocks)
    for (const Point& p : block.polygon)
      if (!is_far(p) && distance_to_boundary(polygon, p) < kTouching &&
          distance_to_corner(polygon, p) > kTouching)
        touching.push_back(p);
  return touching;
}

/// Cuts the mirror image instead and maps the corners back, so that blocks on the right are cut like those on
/// the left.
Triangulation cut_as_mirror_image(const Polygon& polygon, double axis) {
  const int n = static_cast<int>(polygon.size());
  Triangulation result = cut_between_corners(mirrored(polygon, axis));
  result.points = polygon;
  for (auto& triangle : result.triangles)
    triangle = {n - 1 - triangle[2], n - 1 - triangle[1], n - 1 - triangle[0]};
  return result;
}

bool symmetric(const Polygon& polygon, double axis) {
  return std::all_of(polygon.begin(), polygon.end(), [&](const Point& p) {
    return distance_to_corner(polygon, {2.0 * axis - p.x(), p.y()}) < kOnAxis;
  });
}

/// What lies left of the axis, cut between its corners, and its mirror image.
Triangulation cut_in_halves(const Polygon& polygon, double axis) {
  const Box box = box_of(polygon);
  const Polygon right_side = {{axis, box.min().y() - 1.0},
                              {box.max().x() + 1.0, box.min().y() - 1.0},
                              {box.max().x() + 1.0, box.max().y() + 1.0},
                              {axis, box.max().y() + 1.0}};
  Triangulation result = cut_between_corners(subtract(polygon, right_side, 0.0).front());
  std::vector<int> image;
  for (std::size_t i = 0, n = result.points.size(); i < n; ++i) {
    const Point p = result.points[i];
    const bool on_axis = std::abs(p.x() - axis) < kOnAxis;
    image.push_back(static_cast<int>(on_axis ? i : result.points.size()));
    if (!on_axis) result.points.emplace_back(2.0 * axis - p.x(), p.y());
  }
  const auto image_of = [&](int corner) { return image[static_cast<std::size_t>(corner)]; };
  for (std::size_t t = 0, n = result.triangles.size(); t < n; ++t) {
    const auto [a, b, c] = result.triangles[t];
    result.triangles.push_back({image_of(c), image_of(b), image_of(a)});
  }
  return result;
}

Triangulation cut(const Block& block, double axis) {
  const Polygon& polygon = block.polygon;
  const double from_axis = centroid(polygon).x() - axis;
  if (block.kind == BlockKind::voussoir) return fan_about_edge(polygon, 3);  // the extrados chord
  const bool round = block.kind == BlockKind::leg || (block.top_course && polygon.size() == 4);
  if ((round || std::abs(from_axis) < kOnAxis) && centre_sees_corners(polygon))
    return fan_about_centre(polygon);
  if (std::abs(from_axis) < kOnAxis && symmetric(polygon, axis)) return cut_in_halves(polygon, axis);
  return from_axis < 0.0 ? cut_between_corners(polygon) : cut_as_mirror_image(polygon, axis);
}

Triangulation triangulate(const Block& block, const BlockLayout& layout, const MeshDescription& rule,
                          double axis) {
  Triangulation result = cut(block, axis);
  if (rule.split_at_corners)
    for (const Point& corner : touching_corners(block.polygon, layout.blocks))
      split_boundary_at(result, corner, kTouching);
  for (int level = 0; level < rule.refinement; ++level) result = refined(result);
  return result;
}

void append(const Triangulation& part, std::vector<Point>& points, Mesh& mesh) {
  const int first_node = static_cast<int>(points.size());
  const auto node = [&](int local) { return NodeId{first_node + local}; };
  const auto range_since = [](int begin, std::size_t end) {
    return IndexRange{begin, static_cast<int>(end)};
  };
  const int first_triangle = static_cast<int>(mesh.triangles.size());
  const int first_edge = static_cast<int>(mesh.edges.size());

  points.insert(points.end(), part.points.begin(), part.points.end());
  for (const auto& t : part.triangles) mesh.triangles.push_back({{node(t[0]), node(t[1]), node(t[2])}});
  for (const auto& e : boundary(part)) mesh.edges.push_back({node(e[0]), node(e[1])});
  mesh.block_nodes.push_back(range_since(first_node, points.size()));
  mesh.block_triangles.push_back(range_since(first_triangle, mesh.triangles.size()));
  mesh.block_edges.push_back(range_since(first_edge, mesh.edges.size()));
}

}  // namespace

Eigen::Vector3d barycentric_coordinates(const Mesh& mesh, const Triangle& triangle, const Point& place) {
  const Point a = mesh.position(triangle.nodes[0]);
  const Point ab = mesh.position(triangle.nodes[1]) - a;
  const Point ac = mesh.position(triangle.nodes[2]) - a;
  const double twice_area = cross(ab, ac);
  const double b = cross(place - a, ac) / twice_area;
  const double c = cross(ab, place - a) / twice_area;
  return {1.0 - b - c, b, c};
}

Mesh make_mesh(const BlockLayout& layout, const MeshDescription& rule, double mirror_axis) {
  Mesh mesh;
  std::vector<Point> points;
  for (const Block& block : layout.blocks)
    append(triangulate(block, layout, rule, mirror_axis), points, mesh);
  mesh.nodes.resize(2, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) mesh.nodes.col(static_cast<Eigen::Index>(i)) = points[i];
  return mesh;
}

}  // namespace voussoir
