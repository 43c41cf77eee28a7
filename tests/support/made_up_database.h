#pragma once
/// @file Databases with made-up fields: quick to make, each scene different from every other.

#include <cmath>
#include <limits>

#include "core/bridge_file/bridge_file.h"
#include "core/error.h"
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
    const IndexRange gone = bridge.mesh.block_nodes.at(static_cast<std::size_t>(value(id)));
    field.middleCols(gone.begin, gone.size()).setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  const bool collapsed = static_cast<int>(10.0 * phase) % 7 == 3;
  Solution solution;
  solution.outcome = collapsed ? Outcome::collapsed : Outcome::standing;
  solution.displacement = to_storage_precision(field);
  solution.residual = 1e-11 * (1.0 + phase);
  solution.iterations = 5 + scene.missing();
  if (collapsed) solution.moving = {BlockId{static_cast<std::int32_t>(10.0 * phase) % bridge.block_count()}};
  if (collapsed && scene.missing() > 1) solution.origin = Origin::inherited;
  solution.extent = collapse_extent(bridge.layout, solution.moving);
  return solution;
}

inline Provenance made_up_provenance(const BridgeFile& file) {
  return make_provenance(file, "solver = made up\ntolerance = 1e-10\n", "made up");
}

/// The parameters of the bridge file, and in other variants different ones for every block and joint.
inline VariantParameters made_up_parameters(const Model& bridge, std::size_t variant) {
  const auto numbers = [&](std::size_t count, double nominal) {
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i)
      values.push_back(nominal * (1.0 + 1e-3 * static_cast<double>(variant * (i + 1))));
    return values;
  };
  const Material& material = bridge.parameters.blocks.front();
  const JointMaterial& joint = bridge.parameters.contact;
  const std::size_t blocks = bridge.layout.size();
  const std::size_t joints = bridge.joints.size();
  return {numbers(blocks, material.young_modulus),     numbers(blocks, material.poisson_ratio),
          numbers(blocks, material.density),           numbers(joints, joint.normal_stiffness),
          numbers(joints, joint.tangential_stiffness), numbers(joints, joint.friction_coefficient())};
}

/// Of every joint another.
inline Eigen::Matrix2Xd made_up_slip(const Model& bridge) {
  return to_storage_precision(Field::NullaryExpr(
      2, static_cast<Eigen::Index>(bridge.joints.size()), [](Eigen::Index end, Eigen::Index joint) {
        return 1e-4 * std::sin(0.3 * static_cast<double>(joint) + static_cast<double>(end));
      }));
}

inline Record made_up_record(const Model& bridge, const RecordKey& key, std::size_t states,
                             KeepField fields) {
  std::vector<Solution> solutions;
  for (std::size_t state = 0; state < states; ++state) {
    solutions.push_back(made_up_solution(bridge, key.scene));
    const double scale = 1.0 + key.variant + 10.0 * static_cast<double>(state);
    solutions.back().displacement = to_storage_precision(scale * solutions.back().displacement);
    solutions.back().residual *= scale;
    const bool slides = state == 0 && key.scene.missing() == 1 && stands(solutions.back());
    if (slides) solutions.back().slipped = scale * made_up_slip(bridge);
  }
  return make_record(key, solutions, bridge.control_points, fields, fields);
}

/// Scenes, in their order, of some variants, with made-up numbers in some states.
inline DatabaseContent made_up_content(const BridgeFile& file, const Model& bridge,
                                       const std::vector<Scene>& scenes, KeepField fields = KeepField::yes,
                                       std::size_t variants = 1, std::size_t states = 1) {
  DatabaseContent content{made_up_provenance(file), bridge, {}, {}, {}, fields};
  for (std::size_t variant = 0; variant < variants; ++variant) {
    content.variants.push_back(made_up_parameters(bridge, variant));
    for (const RecordKey& key : keys_of(static_cast<std::int32_t>(variant), scenes))
      content.keys.push_back(key);
  }
  for (std::size_t state = 0; state < states; ++state)
    content.states.push_back(state == 0 ? kBuiltState : "state " + std::to_string(state));
  return content;
}

/// The place among the scenes of a single that falls (made_up_solution).
inline constexpr std::size_t kMadeUpFall = 16;

/// Made-up numbers for the intact bridge and the singles among the scenes, which are in their order; every
/// fifth single has none in the last state. Two sampled bridges show what is left of signals. In the last
/// state a single that falls (made_up_solution) stands in some bridges.
inline Sensitivities made_up_sensitivities(const Model& bridge, const std::vector<Scene>& scenes,
                                           std::size_t states) {
  const auto points = static_cast<Eigen::Index>(bridge.control_points.size());
  double phase = 0.0;
  const auto numbers = [&](Eigen::Index rows, Eigen::Index columns) -> Eigen::MatrixXd {
    return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return 1e-4 * std::sin(phase += 0.7); });
  };
  Sensitivities made;
  made.parameters = {{"stiffness a/b", "1", 0.2, false},
                     {"young modulus", "1", 0.25, false},
                     {"density", "1", 0.05, false},
                     {"temperature", "K", 10.0, true},
                     {"base dy", "m", 1e-3, true}};
  made.basis = Eigen::MatrixXd::Identity(3, 2);
  for (const Scene& scene : scenes)
    if (scene.missing() < 2) made.scenes.push_back(scene);
  made.make_room(states, points, 2);
  for (std::size_t state = 0; state < states; ++state) {
    for (std::size_t i = 0; i < made.scenes.size(); ++i)
      if (state + 1 < states || i % 5 != 4)
        made.set(
            state, i,
            SceneFactors{numbers(points, 2), numbers(points, 2), (i > 0 ? 1.0 : 0.0) * numbers(points, 2)});
    made.residuals[state] = {numbers(points, 4), numbers(points, 5), 0.1, 0.2, 0.3, 0.4};
    made.unevenness.push_back(numbers(points, 6));
  }
  made.load = {{0.0, 0.5, 1.5}, numbers(points, 3)};
  if (made.scenes.size() > kMadeUpFall) made.set_fall(states - 1, kMadeUpFall, {0.25, numbers(points, 1)});
  return made;
}

/// Writes made-up records of all keys of the content.
inline WrittenDatabase write_made_up_records(const std::filesystem::path& path,
                                             const DatabaseContent& content) {
  return write_database(path, content, [&](std::size_t row) {
    return made_up_record(content.bridge, content.keys[row], content.states.size(), content.fields);
  });
}

inline WrittenDatabase write_made_up_database(const std::filesystem::path& path, const BridgeFile& file,
                                              const std::vector<Scene>& scenes,
                                              KeepField fields = KeepField::yes, std::size_t variants = 1,
                                              std::size_t states = 1) {
  const Model bridge = make_model(file.description);
  return write_made_up_records(path, made_up_content(file, bridge, scenes, fields, variants, states));
}

}  // namespace voussoir::test
