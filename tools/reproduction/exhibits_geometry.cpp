#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/bridge_file/bridge_file.h"
#include "lookup/report/drawing/bridge_drawing.h"
#include "lookup/report/words.h"
#include "tools/reproduction/exhibits.h"

namespace voussoir {
namespace {

constexpr double kAbove = 0.45, kBelow = 0.2;  // [m] free
constexpr int kNamedEvery = 5;                 // control points with their names written

std::string index_element(const Block& block, const BridgeFrame& frame) {
  return text_element(frame(centroid(block.polygon)) + Point(0.0, 3.0), "middle", "tiny", block.label);
}

std::string point_element(const Subject& subject, const BridgeFrame& frame, std::size_t i) {
  const StoredPoint& point = subject.database.control_points()[i];
  const bool top = subject.database.layout()[point.block].top_course;
  const int number = std::stoi(point.name.substr(1));
  const Point at = frame(point.position);
  std::string text =
      fmt::format("<circle class=\"f2\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.6\">{}</circle>\n", at.x(), at.y(),
                  tip_element(fmt::format("{}\nx {:.4g} m, y {:.4g} m", point.name, point.position.x(),
                                          point.position.y())));
  if (number != 1 && number % kNamedEvery != 0) return text;
  if (top) return text + text_element(at + Point(0.0, -8.0), "middle", "label", point.name);
  const bool left = at.x() < 0.5 * frame.width;  // names stand in the opening
  return text +
         text_element(at + Point(left ? 6.0 : -6.0, 10.0), left ? "start" : "end", "label", point.name);
}

Drawing draw_geometry(const Subject& subject) {
  const BlockLayout& layout = subject.database.layout();
  const BridgeFrame frame = frame_of(layout, kBridgeWidth, kAbove, kBelow);
  std::string elements =
      ground_element(layout, frame) + block_elements(layout, frame, [&](BlockId id) {
        return BlockLook{"stone", fmt::format("({})\n{}", layout[id].label, place_in_words(id, layout))};
      });
  for (const Block& block : layout.blocks) elements += index_element(block, frame);
  for (std::size_t i = 0; i < subject.database.control_points().size(); ++i)
    elements += point_element(subject, frame, i);
  return {frame.width, frame.height, "The blocks with their indices, and the control points", elements};
}

Table block_table(const BlockLayout& layout) {
  Table table{{"block", "course x1", "position x2", "centre x [m]", "centre y [m]", "area [m2]"}, {}};
  for (const Block& block : layout.blocks) {
    const Point centre = centroid(block.polygon);
    table.rows.push_back({block.label, static_cast<double>(block.index.course),
                          static_cast<double>(block.index.position), centre.x(), centre.y(),
                          area(block.polygon)});
  }
  return table;
}

Exhibit geometry_exhibit(const Subject& subject) {
  const BlockLayout& layout = subject.database.layout();
  const auto in_arch =
      std::ranges::count_if(layout.blocks, [](const Block& block) { return block.index.course == 0; });
  const std::string caption = fmt::format(
      "{} blocks, {} of them in the arch, and {} control points (T on top, A on the intrados). Course 0 is "
      "the "
      "arch; positions count from the left.",
      layout.size(), in_arch, subject.database.control_points().size());
  return {{"figure-1", "Fig. 1: blocks and control points", caption, panorama_html(draw_geometry(subject)),
           block_table(layout), true}};
}

/// How a kind of block is cut into triangles, with its colour.
struct MeshRule {
  std::string name;
  int colour = 0;
};

MeshRule rule_of(const Block& block) {
  if (block.kind == BlockKind::leg || (block.top_course && block.kind == BlockKind::plain))
    return {"legs and the top course (four)", 4};
  if (block.kind == BlockKind::voussoir) return {"voussoirs (three)", 3};
  return block.kind == BlockKind::plain ? MeshRule{"plain blocks (two)", 1}
                                        : MeshRule{"blocks cut by the arch (as few as fit)", 5};
}

std::string triangles_of(const Mesh& mesh, std::size_t block, const BridgeFrame& frame) {
  std::string data;
  for (int t = mesh.block_triangles[block].begin; t < mesh.block_triangles[block].end; ++t) {
    std::vector<Point> corners;
    for (const NodeId node : mesh.triangles[static_cast<std::size_t>(t)].nodes)
      corners.push_back(frame(mesh.position(node)));
    data += closed_path(corners);
  }
  return data;
}

Drawing draw_mesh(const Subject& subject) {
  const BlockLayout& layout = subject.database.layout();
  const BridgeFrame frame = frame_of(layout, kBridgeWidth, 0.1, kBelow);
  std::string elements = ground_element(layout, frame);
  for (std::size_t i = 0; i < layout.size(); ++i)
    elements += path_element(fmt::format("mesh f{0}", rule_of(layout.blocks[i]).colour),
                             triangles_of(subject.database.mesh(), i, frame),
                             fmt::format("({})\n{} triangles", layout.blocks[i].label,
                                         subject.database.mesh().block_triangles[i].size()));
  return {frame.width, frame.height, "The triangles of the blocks", elements};
}

Mesh paper_mesh(const Subject& subject, const BridgeDescription& description) {
  MeshDescription rule = description.mesh;
  rule.refinement = 0;
  rule.split_at_corners = false;
  return make_mesh(subject.database.layout(), rule, 0.5 * description.wall.length);
}

/// Blocks and triangles of each rule: as the rule has it, and with edges split where neighbours touch.
Table mesh_table(const Subject& subject, const Mesh& whole) {
  struct Count {
    double blocks = 0.0, whole = 0.0, split = 0.0;
  };
  std::map<std::string, Count> counts;
  const BlockLayout& layout = subject.database.layout();
  for (std::size_t i = 0; i < layout.size(); ++i)
    for (const std::string& name : {rule_of(layout.blocks[i]).name, std::string("together")}) {
      Count& count = counts[name];
      count.blocks += 1.0;
      count.whole += whole.block_triangles[i].size();
      count.split += subject.database.mesh().block_triangles[i].size();
    }
  Table table{{"blocks of this kind", "blocks", "triangles, edges whole", "triangles in the database"}, {}};
  for (const auto& [name, count] : counts)
    table.rows.push_back({name, count.blocks, count.whole, count.split});
  return table;
}

Exhibit mesh_exhibit(const Subject& subject) {
  const BridgeDescription description =
      parse_bridge_file(subject.database.bridge_text(), subject.database.bridge_name()).description;
  const Mesh whole = paper_mesh(subject, description);
  std::string caption = fmt::format(
      "{} triangles by the rule that colours tell{}, {} in the database, whose edges are also split where a "
      "neighbour's corner touches them. {} nodes; the base is clamped, the sides can only move up and down.",
      whole.triangles.size(),
      subject.cases.triangles ? fmt::format(" (the paper counts {})", *subject.cases.triangles) : "",
      subject.database.mesh().triangles.size(), subject.database.mesh().node_count());
  std::vector<Series> legend;
  for (const MeshRule& rule :
       {MeshRule{"plain blocks (two)", 1}, MeshRule{"voussoirs (three)", 3},
        MeshRule{"legs and the top course (four)", 4}, MeshRule{"blocks cut by the arch (as few as fit)", 5}})
    legend.push_back({rule.name, rule.colour, Mark::band, {}, {}});
  return {{"figure-2", "Fig. 2: triangles", caption, legend_html(legend) + panorama_html(draw_mesh(subject)),
           mesh_table(subject, whole), true}};
}

}  // namespace

std::vector<Exhibit> geometry_exhibits(const Subject& subject) {
  return {geometry_exhibit(subject), mesh_exhibit(subject)};
}

}  // namespace voussoir
