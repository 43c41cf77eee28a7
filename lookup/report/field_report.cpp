#include "lookup/report/field_report.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>

#include "lookup/report/drawing/field_drawing.h"

namespace voussoir {
namespace {

constexpr int kVtkTriangle = 5;

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

std::string number_or_nothing(double number) {
  return std::isnan(number) ? "" : fmt::format("{}", number);
}

std::string field_csv(const SceneField& scene) {
  std::string text = "course,position,x_m,y_m,ux_m,uy_m\n";
  scene.for_each_block([&](std::size_t block) {
    const BlockIndex index = scene.database.layout().blocks[block].index;
    const IndexRange nodes = scene.mesh.block_nodes[block];
    for (int node = nodes.begin; node < nodes.end; ++node)
      fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{}\n", index.course, index.position,
                     scene.mesh.nodes(0, node), scene.mesh.nodes(1, node), scene.field(0, node),
                     scene.field(1, node));
  });
  return text;
}

std::string field_json(const SceneField& scene) {
  auto list = nlohmann::ordered_json::array();
  scene.for_each_block([&](std::size_t block) {
    const IndexRange nodes = scene.mesh.block_nodes[block];
    for (int node = nodes.begin; node < nodes.end; ++node)
      list.push_back({{"block", to_string(scene.database.layout().blocks[block].index)},
                      {"x_m", scene.mesh.nodes(0, node)},
                      {"y_m", scene.mesh.nodes(1, node)},
                      {"ux_m", scene.field(0, node)},
                      {"uy_m", scene.field(1, node)}});
  });
  return list.dump(1) + "\n";
}

/// The pieces of a VTK file that grow together, block after block.
struct VtkArrays {
  std::string points, displacements, connectivity, offsets, types, courses, positions;
  int point_count = 0;
  int cell_count = 0;
};

void append_block(const SceneField& scene, std::size_t block, VtkArrays& arrays) {
  const BlockIndex index = scene.database.layout().blocks[block].index;
  const IndexRange nodes = scene.mesh.block_nodes[block];
  const IndexRange triangles = scene.mesh.block_triangles[block];
  const int shift = arrays.point_count - nodes.begin;
  for (int node = nodes.begin; node < nodes.end; ++node) {
    arrays.points += fmt::format("{} {} 0\n", scene.mesh.nodes(0, node), scene.mesh.nodes(1, node));
    arrays.displacements += fmt::format("{} {} 0\n", scene.field(0, node), scene.field(1, node));
  }
  for (int t = triangles.begin; t < triangles.end; ++t) {
    const auto& corners = scene.mesh.triangles[static_cast<std::size_t>(t)].nodes;
    arrays.connectivity += fmt::format("{} {} {}\n", value(corners[0]) + shift, value(corners[1]) + shift,
                                       value(corners[2]) + shift);
    arrays.offsets += fmt::format("{}\n", 3 * ++arrays.cell_count);
    arrays.types += fmt::format("{}\n", kVtkTriangle);
    arrays.courses += fmt::format("{}\n", index.course);
    arrays.positions += fmt::format("{}\n", index.position);
  }
  arrays.point_count += nodes.size();
}

std::string data_array(std::string_view type, std::string_view name, int components,
                       const std::string& values) {
  return fmt::format(
      "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n{}</DataArray>\n",
      type, name, components, values);
}

std::string field_vtu(const SceneField& scene) {
  VtkArrays arrays;
  scene.for_each_block([&](std::size_t block) { append_block(scene, block, arrays); });
  return fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n"
      "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n"
      "<PointData Vectors=\"displacement_m\">\n{}</PointData>\n<CellData>\n{}{}</CellData>\n"
      "<Points>\n{}</Points>\n<Cells>\n{}{}{}</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n",
      arrays.point_count, arrays.cell_count, data_array("Float64", "displacement_m", 3, arrays.displacements),
      data_array("Int32", "course", 1, arrays.courses), data_array("Int32", "position", 1, arrays.positions),
      data_array("Float64", "points_m", 3, arrays.points),
      data_array("Int32", "connectivity", 1, arrays.connectivity),
      data_array("Int32", "offsets", 1, arrays.offsets), data_array("UInt8", "types", 1, arrays.types));
}

std::string field_svg(const SceneField& scene, const std::string& state, Outcome outcome) {
  const BlockLayout& layout = scene.database.layout();
  const std::string name =
      scene.scene.removed.empty() ? "intact" : "without " + to_string(scene.scene, layout);
  const bool tells_state = scene.database.states().size() > 1;
  const std::string heading = fmt::format("Bridge '{}' {}{}, {}", scene.database.bridge_name(), name,
                                          tells_state ? " as " + state : "", to_string(outcome));
  return svg_file(draw_field({layout, scene.mesh, scene.scene, scene.field, heading}));
}

nlohmann::ordered_json number_or_null(double number) {
  return std::isnan(number) ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(number);
}

}  // namespace

std::string places_csv(const std::vector<PlaceDisplacement>& places) {
  std::string text = "point,ux_m,uy_m\n";
  for (const PlaceDisplacement& place : places) {
    const bool quotes = place.name.find(',') != std::string::npos;
    text += fmt::format("{0}{1}{0},{2},{3}\n", quotes ? "\"" : "", place.name,
                        number_or_nothing(place.displacement.x()), number_or_nothing(place.displacement.y()));
  }
  return text;
}

std::string places_json(const std::vector<PlaceDisplacement>& places) {
  auto list = nlohmann::ordered_json::array();
  for (const PlaceDisplacement& place : places)
    list.push_back({{"point", place.name},
                    {"ux_m", number_or_null(place.displacement.x())},
                    {"uy_m", number_or_null(place.displacement.y())}});
  return list.dump(1) + "\n";
}

std::string field_report(const Database& database, std::size_t row, std::size_t state, FieldFormat format) {
  const SceneTable table = database.table(kNominalVariant, state);
  const SceneField scene{database, database.mesh(), table.scene(row), database.field(row, state)};
  switch (format) {
    case FieldFormat::vtu:
      return field_vtu(scene);
    case FieldFormat::svg:
      return field_svg(scene, database.states()[state], static_cast<Outcome>(table.outcome[row]));
    case FieldFormat::json:
      return field_json(scene);
    default:
      return field_csv(scene);
  }
}

}  // namespace voussoir
