#include "database/records/stored_bridge.h"

#include "core/bridge_file/bridge_file.h"
#include "core/error.h"
#include "database/records/schema.h"

namespace voussoir {
namespace {

std::vector<ControlPoint> stored_points(const Database& database) {
  const ByteView bytes = database.dataset_bytes(dataset::kPointNode);
  std::vector<std::int32_t> nodes(bytes.size() / sizeof(std::int32_t));
  std::memcpy(nodes.data(), bytes.data(), nodes.size() * sizeof(std::int32_t));
  const auto& stored = database.control_points();
  if (nodes.size() != stored.size())
    throw InputError(fmt::format("{}: dataset '{}' has {} rows where {} were expected",
                                 database.path().string(), dataset::kPointNode, nodes.size(), stored.size()));
  auto weights = database.point_weights();
  std::vector<ControlPoint> points;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const IndexRange& own = database.mesh().block_nodes.at(static_cast<std::size_t>(stored[i].block));
    if (!own.contains(nodes[i]))
      throw InputError(fmt::format("{}: control point {} has node {}, expected one of its block's ({} to {})",
                                   database.path().string(), stored[i].name, nodes[i], own.begin,
                                   own.end - 1));
    points.push_back({stored[i].name, NodeId{nodes[i]}, stored[i].block, stored[i].position,
                      stored[i].quantity, std::move(weights[i]), stored[i].other_block});
  }
  return points;
}

}  // namespace

BridgeDescription description_of(const Database& database) {
  return parse_bridge_file(database.bridge_text(), database.path().string() + " (bridge text)").description;
}

Model bridge_of(const Database& database) {
  const BridgeDescription description = description_of(database);
  Structure structure;
  structure.layout = database.layout();
  structure.mesh = database.mesh();
  structure.joints = database.joints();
  const Bounds bounds = bounds_of(description);
  structure.supports = supports_of(description, structure.layout, structure.mesh);
  structure.control_points = stored_points(database);
  structure.symmetry =
      find_mirror_symmetry(structure.layout, structure.mesh, bounds.corner.x() + 0.5 * bounds.length);
  return with_nominal_parameters(std::move(structure), description);
}

SceneStates stored_states(const Database& database, std::size_t row, const StatePlan& plan) {
  SceneStates states(plan.size());
  for (std::size_t state = 0; state < plan.size(); ++state)
    if (const auto stored = database.find_state(plan[state].name))
      states[state] = database.solution(row, *stored);
  return states;
}

}  // namespace voussoir
