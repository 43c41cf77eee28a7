#include "lookup/report/field_query.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "core/error.h"
#include "core/solve/state_name.h"
#include "core/structure/reading_weights.h"
#include "core/text.h"

namespace voussoir {
namespace {

constexpr double kInside = 1e-9;  // barycentric coordinates may be negative by this much: rounding

/// Tilts and distances are of no one place.
bool moves(const StoredPoint& point) {
  return point.quantity == Quantity::ux || point.quantity == Quantity::uy;
}

/// What a database without fields knows of a point: what it reads.
Point read_displacement(const StoredPoint& point, double reading) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  return point.quantity == Quantity::ux ? Point(reading, kUnknown) : Point(kUnknown, reading);
}

/// Of the place of a point, by the triangle of its block about it.
Point displacement_of(const StoredPoint& point, const Mesh& mesh, const Field& field) {
  const Place place{point.position, point.block};
  return {weighted_sum(displacement_weights(place, Point(1.0, 0.0), mesh), field),
          weighted_sum(displacement_weights(place, Point(0.0, 1.0), mesh), field)};
}

std::vector<PlaceDisplacement> at_points(const Database& database, std::size_t row, std::size_t state,
                                         const std::vector<std::size_t>& points) {
  const bool has_fields = database.has_fields();
  const SceneTable table = database.table(kNominalVariant, state);
  const Field field = has_fields ? database.field(row, state) : Field();
  std::vector<PlaceDisplacement> result;
  for (const std::size_t i : points) {
    const StoredPoint& point = database.control_points()[i];
    result.push_back({point.name,
                      has_fields ? displacement_of(point, database.mesh(), field)
                                 : read_displacement(point, table.row(row)[i]),
                      point.position});
  }
  return result;
}

std::size_t find_point(const Database& database, std::string_view name) {
  const auto& points = database.control_points();
  const auto found = std::find_if(points.begin(), points.end(),
                                  [&](const StoredPoint& point) { return point.name == name; });
  if (found == points.end())
    throw InputError(
        fmt::format("--at: unknown point {}, expected control, coordinates X,Y in metres, or names: {}",
                    in_quotes(name), names_in_words(names_of(points))));
  if (!moves(*found))
    throw InputError(fmt::format("--at: sensor {} reads a {}, expected a point that moves", in_quotes(name),
                                 to_string(found->quantity)));
  return static_cast<std::size_t>(found - points.begin());
}

/// Of each block that is there: more than one where blocks meet.
std::vector<std::pair<BlockId, Point>> displacements_of_place(const Database& database, std::size_t row,
                                                              std::size_t state, const Point& place) {
  const Mesh& mesh = database.mesh();
  std::vector<std::pair<BlockId, Point>> found;
  const Scene scene = database.table().scene(row);
  const Field field = database.field(row, state);
  for (std::size_t b = 0; b < mesh.block_triangles.size(); ++b) {
    const BlockId block{static_cast<std::int32_t>(b)};
    if (scene.lacks(block)) continue;
    for (int t = mesh.block_triangles[b].begin; t < mesh.block_triangles[b].end; ++t) {
      const Triangle& triangle = mesh.triangles[static_cast<std::size_t>(t)];
      const Eigen::Vector3d weights = barycentric_coordinates(mesh, triangle, place);
      if (!(weights.minCoeff() >= -kInside)) continue;  // nor if it is no number
      Point result = Point::Zero();
      for (int corner = 0; corner < 3; ++corner)
        result += weights[corner] * field.col(value(triangle.nodes.at(static_cast<std::size_t>(corner))));
      found.emplace_back(block, result);
      break;
    }
  }
  if (!found.empty()) return found;
  throw InputError(
      fmt::format("--at: there is no block at x = {} m, y = {} m in scene {}, expected a place within one",
                  place.x(), place.y(), to_string(scene, database.layout())));
}

std::vector<PlaceDisplacement> at_place(const Database& database, std::size_t row, std::size_t state,
                                        const Point& place) {
  const auto blocks = displacements_of_place(database, row, state, place);
  std::vector<PlaceDisplacement> result;
  for (const auto& [block, displacement] : blocks)
    result.push_back({fmt::format("{},{}{}", place.x(), place.y(),
                                  blocks.size() > 1 ? " of block " + database.layout()[block].label : ""),
                      displacement, place});
  return result;
}

/// "--history lost --load truck@2"
std::string as_options(std::string_view state) {
  const std::string_view load = load_stage_of(state);
  return fmt::format("--history {}{}{}", history_of(state), load.empty() ? "" : " --load ",
                     load.empty() ? "" : in_quotes(load));
}

std::optional<Point> parse_place(const std::vector<std::string_view>& parts) {
  if (parts.size() != 2) return std::nullopt;
  const std::optional<double> x = parse_number(parts[0]);
  const std::optional<double> y = parse_number(parts[1]);
  if (!x || !y) return std::nullopt;
  return Point(*x, *y);
}

}  // namespace

std::size_t find_state(const Database& database, const std::optional<std::string>& history,
                       const std::optional<std::string>& load) {
  const std::string name =
      state_name(history ? *history : history_of(database.states().front()), load.value_or(""));
  const auto state = database.find_state(name);
  if (state) return *state;
  std::vector<std::string> states;
  for (const std::string& one : database.states()) states.push_back(as_options(one));
  throw InputError(fmt::format("{}: nothing is solved for {}, expected one of: {}", database.path().string(),
                               as_options(name), fmt::join(states, "; ")));
}

std::size_t find_row(const Database& database, std::string_view text) {
  const Scene scene = parse_scene(text, database.layout());
  const std::optional<std::size_t> row = database.find(scene);
  if (row) return *row;
  const std::size_t most = database.table(kNominalVariant, 0).most_missing;
  const std::string why = database.shard() ? fmt::format("it is part {}", to_string(database.shard()->shard))
                          : static_cast<std::size_t>(scene.missing()) > most
                              ? fmt::format("its scenes have at most {} missing blocks", most)
                              : "it was built with others (--scenes)";
  throw Failure(fmt::format("{}: has no scene {}, as {}", database.path().string(),
                            to_string(scene, database.layout()), why));
}

void expect_displacements(const Database& database, std::size_t row, std::size_t state) {
  const SceneTable table = database.table(kNominalVariant, state);
  const bool stands = static_cast<Outcome>(table.outcome[row]) == Outcome::standing;
  if (stands || table.has_displacements(row)) return;  // one that stands may have lost all points
  throw Failure(fmt::format(
      "{}: scene {} falls as {}, and the database keeps only that: expected one built with "
      "--collapses field{}",
      database.path().string(), to_string(database.key(row).scene, database.layout()),
      database.states()[state], database.key(row).scene.missing() > 2 ? ", and --without inherited" : ""));
}

std::vector<PlaceDisplacement> displacements_at(const Database& database, std::size_t row, std::size_t state,
                                                std::string_view at) {
  const std::vector<std::string_view> parts = split(at, ',');
  if (const std::optional<Point> place = parse_place(parts)) return at_place(database, row, state, *place);
  std::vector<std::size_t> points;
  if (at == "control")
    for (std::size_t i = 0; i < database.control_points().size(); ++i) {
      if (moves(database.control_points()[i])) points.push_back(i);
    }
  else
    for (const std::string_view name : parts) points.push_back(find_point(database, name));
  return at_points(database, row, state, points);
}

}  // namespace voussoir
