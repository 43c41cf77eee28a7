#include "lookup/report/forces_report.h"

#include <map>

#include "lookup/report/drawing/forces_drawing.h"
#include "lookup/report/drawing/table.h"

namespace voussoir {
namespace {

/// What all writers look at.
struct ForcesView {
  const Database& database;
  SceneForces forces;

  const std::string& label(BlockId block) const {
    return database.layout().blocks[static_cast<std::size_t>(value(block))].label;
  }
};

Table stress_table(const ForcesView& view) {
  const Mesh& mesh = view.database.mesh();
  Table table{{"block", "x_m", "y_m", "stress_xx_Pa", "stress_yy_Pa", "stress_xy_Pa", "tresca_Pa"}, {}};
  for (std::size_t block = 0; block < mesh.block_triangles.size(); ++block) {
    const BlockId id{static_cast<std::int32_t>(block)};
    if (view.forces.scene.lacks(id)) continue;
    for (int t = mesh.block_triangles[block].begin; t < mesh.block_triangles[block].end; ++t) {
      Point middle = Point::Zero();
      for (const NodeId node : mesh.triangles[static_cast<std::size_t>(t)].nodes)
        middle += mesh.nodes.col(value(node)) / 3.0;
      const TriangleStress& stress = view.forces.triangles[static_cast<std::size_t>(t)];
      table.rows.push_back(
          {view.label(id), middle.x(), middle.y(), stress.xx, stress.yy, stress.xy, stress.tresca});
    }
  }
  return table;
}

Table joint_table(const ForcesView& view) {
  Table table{
      {"first", "second", "x0_m", "y0_m", "x1_m", "y1_m", "state", "pressure0_Pa", "pressure1_Pa", "normal_N",
       "shear_N", "gap0_m", "gap1_m", "slip0_m", "slip1_m", "touching_share", "sliding_share"},
      {}};
  for (const JointForces& found : view.forces.joints) {
    const Joint& joint = view.database.joints()[found.joint];
    table.rows.push_back({view.label(joint.first), view.label(joint.second), found.ends[0].x(),
                          found.ends[0].y(), found.ends[1].x(), found.ends[1].y(),
                          std::string(to_string(found.condition)), found.pressure[0], found.pressure[1],
                          found.normal, found.shear, found.gap[0], found.gap[1], found.slip[0], found.slip[1],
                          found.closed_share, found.sliding_share});
  }
  return table;
}

Table thrust_table(const ForcesView& view) {
  Table table{
      {"ring", "first", "second", "x_m", "y_m", "normal_N", "shear_N", "eccentricity_m", "thickness_m"}, {}};
  for (const ThrustPoint& point : view.forces.thrust)
    table.rows.push_back({static_cast<double>(point.ring + 1), view.label(point.first),
                          view.label(point.second), point.at().x(), point.at().y(), point.normal, point.shear,
                          point.eccentricity, point.thickness});
  return table;
}

Table table_of(const ForcesView& view, FieldQuantity quantity) {
  if (quantity == FieldQuantity::stresses) return stress_table(view);
  return quantity == FieldQuantity::joints ? joint_table(view) : thrust_table(view);
}

/// The field's triangles with their stresses beside the displacements.
VtkGrid stress_grid(const ForcesView& view, const Field& field) {
  const Mesh& mesh = view.database.mesh();
  VtkGrid grid = field_grid(mesh, view.database.layout(), view.forces.scene, field);
  VtkArray stresses{"stress_xx_yy_xy_Pa", 3};
  VtkArray tresca{"tresca_Pa", 1};
  for (std::size_t block = 0; block < mesh.block_triangles.size(); ++block) {
    if (view.forces.scene.lacks(BlockId{static_cast<std::int32_t>(block)})) continue;
    for (int t = mesh.block_triangles[block].begin; t < mesh.block_triangles[block].end; ++t) {
      const TriangleStress& stress = view.forces.triangles[static_cast<std::size_t>(t)];
      for (const double component : {stress.xx, stress.yy, stress.xy}) stresses.values.push_back(component);
      tresca.values.push_back(stress.tresca);
    }
  }
  grid.cell_data.push_back(std::move(stresses));
  grid.cell_data.push_back(std::move(tresca));
  return grid;
}

/// A line for each stretch. The state is the number of a JointCondition.
VtkGrid joint_grid(const ForcesView& view) {
  VtkGrid grid{.kind = VtkCell::poly_line};
  VtkArray state{"state_0_open_1_sticking_2_sliding", 1, {}, true};
  VtkArray normal{"normal_N", 1};
  VtkArray shear{"shear_N", 1};
  VtkArray pressure{"pressure_Pa", 1};
  VtkArray gap{"gap_m", 1};
  for (const JointForces& joint : view.forces.joints) {
    const int first = static_cast<int>(grid.points.size());
    grid.cells.push_back({first, first + 1});
    for (std::size_t end = 0; end < 2; ++end) {
      grid.points.push_back(joint.ends.at(end));
      pressure.values.push_back(joint.pressure.at(end));
      gap.values.push_back(joint.gap.at(end));
    }
    state.values.push_back(static_cast<double>(joint.condition));
    normal.values.push_back(joint.normal);
    shear.values.push_back(joint.shear);
  }
  grid.point_data = {std::move(pressure), std::move(gap)};
  grid.cell_data = {std::move(state), std::move(normal), std::move(shear)};
  return grid;
}

/// A line for each ring, through the joints that press.
VtkGrid thrust_grid(const ForcesView& view) {
  VtkGrid grid{.kind = VtkCell::poly_line};
  VtkArray normal{"normal_N", 1};
  std::map<int, std::vector<int>> lines;
  for (const ThrustPoint& point : view.forces.thrust) {
    if (!(point.normal > 0.0)) continue;
    lines[point.ring].push_back(static_cast<int>(grid.points.size()));
    grid.points.push_back(point.at());
    normal.values.push_back(point.normal);
  }
  for (auto& [ring, line] : lines) grid.cells.push_back(std::move(line));
  grid.point_data = {std::move(normal)};
  return grid;
}

std::string forces_vtu(const ForcesView& view, const Field& field, FieldQuantity quantity) {
  if (quantity == FieldQuantity::stresses) return to_vtu(stress_grid(view, field));
  return to_vtu(quantity == FieldQuantity::joints ? joint_grid(view) : thrust_grid(view));
}

std::string forces_svg(const ForcesView& view, FieldQuantity quantity, const std::string& heading) {
  const ForcesPicture picture{view.database.layout(), view.database.mesh(), view.forces.scene, heading};
  if (quantity == FieldQuantity::stresses) return svg_file(draw_stresses(picture, view.forces.triangles));
  return svg_file(quantity == FieldQuantity::joints
                      ? draw_joints(picture, view.forces.joints, view.forces.thrust)
                      : draw_thrust(picture, view.forces.thrust));
}

}  // namespace

std::string forces_report(const Database& database, std::size_t row, std::size_t state,
                          FieldQuantity quantity, FieldFormat format) {
  const ForcesView view{database, scene_forces(database, row, state)};
  switch (format) {
    case FieldFormat::vtu:
      return forces_vtu(view, database.field(row, state), quantity);
    case FieldFormat::svg:
      return forces_svg(view, quantity, scene_heading(database, row, state));
    case FieldFormat::json:
      return to_json(table_of(view, quantity));
    default:
      return to_csv(table_of(view, quantity));
  }
}

}  // namespace voussoir
