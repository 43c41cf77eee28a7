#pragma once
/// @file Databases with made-up fields: quick to make, each scene different from every other.

#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/structure/bridge_file.h"
#include "core/structure/control_point.h"
#include "core/structure/model.h"
#include "database/format/field_codec.h"
#include "database/records/provenance.h"
#include "database/records/writer.h"

namespace voussoir::test {

inline BridgeFile small_bridge_file() {
  return read_bridge_file(std::string(VOUSSOIR_SOURCE_DIR) + "/examples/bridges/small.toml");
}

/// Millimetres that vary from node to node and with the removed blocks; every seventh scene is said to have
/// collapsed, with one block that moves away.
inline Solution made_up_solution(const Model& bridge, const Scene& scene) {
  double phase = 0.0;
  for (const BlockId id : scene.removed) phase = 1.7 * phase + 0.37 * (value(id) + 1);
  Field field(2, bridge.mesh.node_count());
  for (Eigen::Index node = 0; node < field.cols(); ++node) {
    const Point position = bridge.mesh.nodes.col(node);
    field.col(node) << 1e-4 * std::sin(position.x() + phase), -1e-3 * (1.2 + std::cos(position.y() - phase));
  }
  for (const BlockId id : scene.removed) {
    const IndexRange gone = bridge.mesh.block_nodes[static_cast<std::size_t>(value(id))];
    field.middleCols(gone.begin, gone.size()).setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  const bool collapsed = static_cast<int>(10.0 * phase) % 7 == 3;
  Solution solution;
  solution.outcome = collapsed ? Outcome::collapsed : Outcome::standing;
  solution.displacement = to_storage_precision(field);
  solution.residual = 1e-11 * (1.0 + phase);
  solution.iterations = 5 + scene.missing();
  if (collapsed) solution.moving = {BlockId{static_cast<std::int32_t>(10.0 * phase) % bridge.block_count()}};
  solution.extent = collapse_extent(bridge.layout, solution.moving);
  return solution;
}

inline Provenance made_up_provenance(const BridgeFile& file) {
  return make_provenance(file, "solver = made up\ntolerance = 1e-10\n", "made up");
}

inline WrittenDatabase write_made_up_database(const std::filesystem::path& path, const BridgeFile& file,
                                              const std::vector<Scene>& scenes,
                                              KeepField fields = KeepField::yes) {
  const Model bridge = make_model(file.description);
  return write_database(path, {made_up_provenance(file), bridge, scenes, fields}, [&](std::size_t row) {
    return make_record(scenes[row], made_up_solution(bridge, scenes[row]), bridge.control_points, fields,
                       fields);
  });
}

}  // namespace voussoir::test
