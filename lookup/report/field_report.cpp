#include "lookup/report/field_report.h"

#include <fmt/format.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/json_text.h"
#include "core/solve/settings.h"
#include "lookup/report/drawing/field_drawing.h"
#include "lookup/report/drawing/table.h"

namespace voussoir {
namespace {

/// A scene's field with the mesh it belongs to.
struct SceneField {
  const Database& database;
  const Mesh& mesh;
  Scene scene;
  Field field;

  /// Calls a function with each block that is there.
  void for_each_block(const std::function<void(std::size_t)>& function) const {
    for (std::size_t block = 0; block < mesh.block_nodes.size(); ++block)
      if (!scene.lacks(BlockId{static_cast<std::int32_t>(block)})) function(block);
  }
};

std::string field_csv(const SceneField& scene) {
  Table table{{"block", "course", "position", "x_m", "y_m", "ux_m", "uy_m"}, {}};
  scene.for_each_block([&](std::size_t block) {
    const Block& laid = scene.database.layout().blocks[block];
    const IndexRange nodes = scene.mesh.block_nodes[block];
    for (int node = nodes.begin; node < nodes.end; ++node)
      table.rows.push_back({laid.label, static_cast<double>(laid.index.course),
                            static_cast<double>(laid.index.position), scene.mesh.nodes(0, node),
                            scene.mesh.nodes(1, node), scene.field(0, node), scene.field(1, node)});
  });
  return to_csv(table);
}

std::string field_json(const SceneField& scene) {
  auto list = nlohmann::ordered_json::array();
  scene.for_each_block([&](std::size_t block) {
    const IndexRange nodes = scene.mesh.block_nodes[block];
    for (int node = nodes.begin; node < nodes.end; ++node)
      list.push_back({{"block", scene.database.layout().blocks[block].label},
                      {"x_m", scene.mesh.nodes(0, node)},
                      {"y_m", scene.mesh.nodes(1, node)},
                      {"ux_m", scene.field(0, node)},
                      {"uy_m", scene.field(1, node)}});
  });
  return json_text(list, 1);
}

/// "moment 0.3 s, "; nothing where another version has written the settings.
std::string moment_in_words(const Database& database) {
  try {
    return fmt::format("moment {:g} s, ",
                       parse_settings(database.provenance().solver_settings).motion.moment);
  } catch (const Failure&) {
    return "";
  }
}

/// "standing", or of what falls the moment that its field is of.
std::string outcome_in_words(const Database& database, Outcome outcome) {
  if (outcome != Outcome::collapsed) return std::string(to_string(outcome));
  return "falling, " + moment_in_words(database) + "not in equilibrium";
}

}  // namespace

std::string scene_heading(const Database& database, std::size_t row, std::size_t state) {
  const SceneTable table = database.table(kNominalVariant, state);
  const Scene scene = table.scene(row);
  return fmt::format("Bridge '{}' {}{}, {}", database.bridge_name(),
                     scene.removed.empty() ? "intact" : "without " + to_string(scene, database.layout()),
                     database.states().size() > 1 ? " as " + database.states()[state] : "",
                     outcome_in_words(database, static_cast<Outcome>(table.outcome[row])));
}

VtkGrid field_grid(const Mesh& mesh, const BlockLayout& layout, const Scene& scene, const Field& field) {
  VtkGrid grid;
  VtkArray displacements{"displacement_m", 3};
  VtkArray blocks{"block", 1, {}, true};  // its number, from 0: blocks of a survey have no course
  VtkArray courses{"course", 1, {}, true};
  VtkArray positions{"position", 1, {}, true};
  for (std::size_t block = 0; block < mesh.block_nodes.size(); ++block) {
    if (scene.lacks(BlockId{static_cast<std::int32_t>(block)})) continue;
    const IndexRange nodes = mesh.block_nodes[block];
    const int shift = static_cast<int>(grid.points.size()) - nodes.begin;
    for (int node = nodes.begin; node < nodes.end; ++node) {
      grid.points.emplace_back(mesh.nodes.col(node));
      for (const double value : {field(0, node), field(1, node), 0.0}) displacements.values.push_back(value);
    }
    const BlockIndex index = layout.blocks[block].index;
    const IndexRange triangles = mesh.block_triangles[block];
    for (int t = triangles.begin; t < triangles.end; ++t) {
      const auto& corners = mesh.triangles[static_cast<std::size_t>(t)].nodes;
      grid.cells.push_back({value(corners[0]) + shift, value(corners[1]) + shift, value(corners[2]) + shift});
      blocks.values.push_back(static_cast<double>(block));
      courses.values.push_back(index.course);
      positions.values.push_back(index.position);
    }
  }
  grid.point_data = {displacements};
  grid.cell_data = {blocks, courses, positions};
  return grid;
}

std::string places_report(const std::vector<PlaceDisplacement>& places, FieldFormat format) {
  Table table{{"point", "ux_m", "uy_m", "x_m", "y_m"}, {}};
  for (const PlaceDisplacement& place : places)
    table.rows.push_back(
        {place.name, place.displacement.x(), place.displacement.y(), place.position.x(), place.position.y()});
  return format == FieldFormat::json ? to_json(table) : to_csv(table);
}

std::string field_report(const Database& database, std::size_t row, std::size_t state, FieldFormat format) {
  const SceneField scene{database, database.mesh(), database.key(row).scene, database.field(row, state)};
  switch (format) {
    case FieldFormat::vtu:
      return to_vtu(field_grid(scene.mesh, scene.database.layout(), scene.scene, scene.field));
    case FieldFormat::svg:
      return svg_file(draw_field(
          {database.layout(), scene.mesh, scene.scene, scene.field, scene_heading(database, row, state)}));
    case FieldFormat::json:
      return field_json(scene);
    default:
      return field_csv(scene);
  }
}

}  // namespace voussoir
