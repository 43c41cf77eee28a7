#include "core/structure/control_point.h"

#include <algorithm>
#include <iterator>

#include "core/error.h"
#include "core/geometry/polygon.h"
#include "core/structure/exposed_edges.h"
#include "core/structure/placed_sensor.h"
#include "core/text.h"

namespace voussoir {
namespace {

NodeId node_at(const Mesh& mesh, BlockId block, const Point& place) {
  const IndexRange range = mesh.block_nodes[static_cast<std::size_t>(value(block))];
  int nearest = range.begin;
  for (int node = range.begin; node < range.end; ++node)
    if ((mesh.nodes.col(node) - place).norm() < (mesh.nodes.col(nearest) - place).norm()) nearest = node;
  return NodeId{nearest};
}

/// Soil and backing lie behind the wall, and arches have points of their own.
bool shows_its_face(BlockRole role) {
  return role != BlockRole::ring && role != BlockRole::backing && role != BlockRole::fill;
}

/// What the middle of a block reads, without a name.
ControlPoint middle_of(const Block& block, BlockId id, const Mesh& mesh) {
  const Point at = centroid(block.polygon);
  ControlPoint point = point_at("", mesh, id, at);
  point.weights = displacement_weights({at, id}, Point(0.0, 1.0), mesh);
  return point;
}

/// Points of one kind, numbered as they come.
struct Family {
  char letter;
  std::vector<ControlPoint> points{};

  std::size_t number = 0;  ///< of the last one

  void add(ControlPoint point) {
    point.name = fmt::format("{}{}", letter, ++number);
    points.push_back(std::move(point));
  }
  void add_pair(const Mesh& mesh, BlockId block, const std::array<Point, 2>& corners) {
    for (const Point& corner : corners) add(point_at("", mesh, block, corner));
  }
};

ControlPoint described_sensor(const SensorDescription& sensor, const BlockLayout& layout, const Mesh& mesh) {
  try {
    PlacedSensor placed = place_sensor(sensor, layout, mesh);
    return {sensor.name,
            node_at(mesh, placed.blocks.front(), placed.position),
            placed.blocks.front(),
            placed.position,
            sensor.quantity,
            std::move(placed.weights),
            placed.blocks.size() > 1 ? std::optional(placed.blocks.back()) : std::nullopt};
  } catch (const InputError& error) {
    throw InputError(fmt::format("sensor {} in [[sensors]]: {}", in_quotes(sensor.name), error.what()));
  }
}

}  // namespace

ControlPoint point_at(const std::string& name, const Mesh& mesh, BlockId block, const Point& place) {
  return {.name = name, .node = node_at(mesh, block, place), .block = block, .position = place};
}

std::vector<ControlPoint> find_control_points(const BlockLayout& layout, const Mesh& mesh,
                                              const ControlPointDescription& kinds) {
  const auto& [top, arch, face] = kinds;
  Family upper{'T'}, intrados{'A'}, middle{'F'};
  auto gone = layout.gone.begin();
  for (std::size_t b = 0; b < layout.size(); ++b) {
    for (; gone != layout.gone.end() && gone->before == b; ++gone) {
      if (gone->block.top_course) upper.number += 2;
      if (gone->block.intrados) intrados.number += 2;
      if (shows_its_face(gone->block.role)) middle.number += 1;
    }
    const Block& block = layout.blocks[b];
    const BlockId id{static_cast<std::int32_t>(b)};
    if (top && block.top_course) upper.add_pair(mesh, id, upper_face(block));
    if (arch && block.intrados) intrados.add_pair(mesh, id, *block.intrados);
    if (face && shows_its_face(block.role)) middle.add(middle_of(block, id, mesh));
  }
  std::vector<ControlPoint> points = std::move(upper.points);
  std::ranges::move(intrados.points, std::back_inserter(points));
  std::ranges::move(middle.points, std::back_inserter(points));
  return points;
}

std::vector<ControlPoint> find_control_points(const BlockLayout& layout, const Mesh& mesh,
                                              const BridgeDescription& description) {
  std::vector<ControlPoint> points = find_control_points(layout, mesh, description.control_points);
  for (const SensorDescription& sensor : description.sensors) {
    if (std::ranges::find(points, sensor.name, &ControlPoint::name) != points.end())
      throw InputError(fmt::format("sensor {} in [[sensors]] is there already, expected another name",
                                   in_quotes(sensor.name)));
    points.push_back(described_sensor(sensor, layout, mesh));
  }
  return points;
}

bool lacks(const Scene& scene, const ControlPoint& point) {
  return scene.lacks(point.block) || (point.other_block && scene.lacks(*point.other_block));
}

double reading_at(const ControlPoint& point, const Field& field) {
  return point.weights.empty() ? field(1, value(point.node)) : weighted_sum(point.weights, field);
}

Eigen::VectorXd readings_at(const std::vector<ControlPoint>& points, const Field& field) {
  Eigen::VectorXd readings(static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    readings[static_cast<Eigen::Index>(i)] = reading_at(points[i], field);
  return readings;
}

}  // namespace voussoir
