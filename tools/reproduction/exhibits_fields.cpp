#include <fmt/format.h>

#include <cmath>

#include "core/units.h"
#include "lookup/readings/simulate.h"
#include "lookup/report/drawing/field_drawing.h"
#include "tools/reproduction/exhibits.h"

namespace voussoir {
namespace {

/// Displacements at all control points [mm], to be drawn as one line.
struct Profile {
  std::string name;
  int colour = 0;
  Mark mark = Mark::line;
  std::vector<double> mm;
};

bool on_arch(const Subject& subject, std::size_t point) {
  return subject.database.layout()[subject.database.control_points()[point].block].role == BlockRole::ring;
}

std::string profile_chart(const Subject& subject, const std::vector<Profile>& profiles, bool arch) {
  Chart chart{arch ? "Displacements of the arch" : "Displacements of the top",
              {arch ? "control point of the arch (A)" : "control point on top (T)"},
              {"vertical displacement [mm]"},
              {}};
  for (const Profile& profile : profiles) {
    Series series{profile.name, profile.colour, profile.mark, {}, {}};
    for (std::size_t point = 0; point < profile.mm.size(); ++point) {
      if (on_arch(subject, point) != arch) continue;
      series.x.push_back(static_cast<double>(series.x.size() + 1));
      series.y.push_back(profile.mm[point]);
    }
    chart.series.push_back(series);
  }
  return chart.series.front().x.empty() ? "" : "<div>" + chart_html(chart) + "</div>\n";
}

std::string profile_charts(const Subject& subject, const std::vector<Profile>& profiles) {
  return "<div class=\"figures\">" + profile_chart(subject, profiles, false) +
         profile_chart(subject, profiles, true) + "</div>\n";
}

Table profile_table(const Subject& subject, const std::vector<Profile>& profiles) {
  Table table{{"point", "x [m]", "y [m]"}, {}};
  for (const Profile& profile : profiles) table.columns.push_back(profile.name + " [mm]");
  for (std::size_t i = 0; i < subject.database.control_points().size(); ++i) {
    const StoredPoint& point = subject.database.control_points()[i];
    table.rows.push_back({point.name, point.position.x(), point.position.y()});
    for (const Profile& profile : profiles) table.rows.back().emplace_back(profile.mm[i]);
  }
  return table;
}

Table node_table(const Subject& subject, std::size_t row) {
  const Field field = subject.database.field(row);
  const Mesh& mesh = subject.database.mesh();
  Table table{{"block", "x [m]", "y [m]", "ux [mm]", "uy [mm]"}, {}};
  for (std::size_t block = 0; block < mesh.block_nodes.size(); ++block)
    for (int node = mesh.block_nodes[block].begin; node < mesh.block_nodes[block].end; ++node)
      table.rows.push_back({subject.database.layout().blocks[block].label, mesh.nodes(0, node),
                            mesh.nodes(1, node), kMillimetres * field(0, node),
                            kMillimetres * field(1, node)});
  return table;
}

/// Where the scene differs most from intact.
std::string largest_change(const Subject& subject, const std::vector<double>& intact,
                           const std::vector<double>& scene) {
  std::size_t largest = 0;
  double most = -1.0;
  for (std::size_t i = 0; i < scene.size(); ++i)
    if (std::abs(scene[i] - intact[i]) > most) {
      most = std::abs(scene[i] - intact[i]);
      largest = i;
    }
  return fmt::format("the largest change at a control point is {:.3g} mm, at {}", most,
                     subject.database.control_points()[largest].name);
}

}  // namespace

Exhibit example_exhibit(const Subject& subject) {
  const PaperCase& example = subject.cases.example;
  const std::size_t row = subject.row(example.scene);
  NoiseModel noise{NoiseShape::uniform, example.noise};
  noise.silence = 0.0;
  Random random(subject.settings.seed);
  Profile noisy{fmt::format("with {:.0f} % noise", 100.0 * example.noise), 2, Mark::dots,
                simulate_readings(subject.database.table().row(row), noise, random).displacement};
  for (double& value : noisy.mm) value *= kMillimetres;
  const std::vector<Profile> profiles = {
      {"intact", 0, Mark::line, subject.settlements_mm(0)},
      {"without " + as_printed(example.scene), 1, Mark::dashes, subject.settlements_mm(row)},
      noisy};
  return {{"figure-4", fmt::format("Fig. 4: displacements of intact and of {}", as_printed(example.scene)),
           fmt::format("Uniform noise relative to each displacement, seed {}. Without {}, {}.",
                       subject.settings.seed, as_printed(example.scene),
                       largest_change(subject, profiles[0].mm, profiles[1].mm)),
           profile_charts(subject, profiles), profile_table(subject, profiles), true}};
}

Exhibit field_exhibit(const Subject& subject, const FieldCase& field) {
  const std::size_t row = subject.row(field.scene);
  const std::string name = as_printed(field.scene);
  const std::vector<Profile> profiles = {{"intact", 0, Mark::dashes, subject.settlements_mm(0)},
                                         {"without " + name, 1, Mark::line, subject.settlements_mm(row)}};
  std::string pictures;
  std::vector<std::pair<std::string, Table>> more;
  const std::string id = "figure-" + field.figure;
  if (subject.database.has_fields()) {
    const Database& database = subject.database;
    pictures = panorama_html(draw_field({database.layout(), database.mesh(), database.table().scene(row),
                                         database.field(row), "Without " + name}));
    more.emplace_back(id + "-field", node_table(subject, row));
  }
  return {{id, fmt::format("Fig. {}: {}", field.figure, name),
           fmt::format("{} {}; {}.", name, outcome_in_words(subject, field.scene),
                       largest_change(subject, profiles[0].mm, profiles[1].mm)),
           pictures + profile_charts(subject, profiles), profile_table(subject, profiles), true},
          more};
}

std::string outcome_in_words(const Subject& subject, const std::string& scene) {
  const RecordedState state = subject.database.record(subject.row(scene)).states.front();
  if (state.outcome == Outcome::standing) return "stands";
  if (state.outcome == Outcome::unresolved) return "has no solution in the database";
  return fmt::format("collapses ({}, {} blocks move away; its field is a moment of the fall)",
                     state.extent == CollapseExtent::arch ? "the arch" : "locally", state.moving.size());
}

}  // namespace voussoir
