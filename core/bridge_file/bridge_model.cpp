#include "core/bridge_file/bridge_model.h"

#include <algorithm>
#include <optional>

#include "core/error.h"

namespace voussoir {
namespace {

constexpr double kEndOfSoil = 0.01;  // [m] that a surveyed surface may end before the bridge does
constexpr double kBuried = 0.05;     // [m] of soil, more than is wiped away

/// Of soil whose surface ends before the bridge does.
void note_soil_that_ends(const std::vector<Point>& surface, const Mesh& mesh,
                         std::vector<std::string>& notes) {
  const double left = mesh.nodes.row(0).minCoeff(), right = mesh.nodes.row(0).maxCoeff();
  const auto note = [&](const char* side, double surface_end, double bridge_end) {
    notes.push_back(
        fmt::format("[fill] weighs nothing {} of x = {:g} m, where its surface ends: the bridge goes on "
                    "to x = {:g} m",
                    side, surface_end, bridge_end));
  };
  if (surface.front().x() > left + kEndOfSoil) note("left", surface.front().x(), left);
  if (surface.back().x() < right - kEndOfSoil) note("right", surface.back().x(), right);
}

/// Height of a surface [m] at x; nothing beside it.
std::optional<double> height_at(const std::vector<Point>& surface, double x) {
  for (std::size_t i = 1; i < surface.size(); ++i) {
    const Point &left = surface[i - 1], &right = surface[i];
    if (x < left.x() || x > right.x() || left.x() == right.x()) continue;
    return left.y() + (right.y() - left.y()) * (x - left.x()) / (right.x() - left.x());
  }
  return std::nullopt;
}

/// Of points on the top of the masonry that soil covers.
void note_buried_points(const BridgeDescription& description, const Model& model,
                        std::vector<std::string>& notes) {
  if (!description.control_points.top) return;
  std::vector<std::string> buried;
  for (const ControlPoint& point :
       find_control_points(model.layout, model.mesh, {.top = true, .arch = false, .face = false})) {
    const auto height = height_at(description.fill.surface, point.position.x());
    if (height && *height > point.position.y() + kBuried) buried.push_back(point.name);
  }
  if (buried.empty()) return;
  const std::size_t shown = std::min<std::size_t>(buried.size(), 3);
  notes.push_back(fmt::format(
      "{} control points on top of the masonry lie under the soil of [fill], where nobody can measure "
      "({}{}): top = false in [control_points] leaves them out, [[sensors]] adds what can be seen",
      buried.size(), fmt::join(buried.begin(), buried.begin() + static_cast<std::ptrdiff_t>(shown), ", "),
      buried.size() > shown ? ", .." : ""));
}

}  // namespace

Model model_of(const BridgeFile& file) {
  try {
    return make_model(file.description);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", file.name, error.what()));
  }
}

std::vector<std::string> without_effect(const BridgeDescription& description, const Model& model) {
  std::vector<std::string> notes;
  for (const Region& region : description.regions)
    for (const std::string& name : region.of)
      if (std::ranges::none_of(model.layout.blocks,
                               [&](const Block& block) { return is_called(block, name); }))
        notes.push_back(
            fmt::format("[[regions]] of '{}' changes nothing: no block of the bridge has this role", name));
  if (!description.movements.empty())
    notes.push_back(
        "[[movements]] changes nothing: tools/reproduce-paper alone follows them, those of the Eindhoven "
        "wall");
  const FillWeight& fill = description.fill;
  if (fill.unit_weight <= 0.0 || description.gravity <= 0.0) return notes;
  if (model.parameters.laid_mass.sum() > 0.0) {
    note_soil_that_ends(fill.surface, model.mesh, notes);
    note_buried_points(description, model, notes);
  } else {
    notes.push_back(fmt::format(
        "[fill] weighs nothing: its surface, at most {:g} m high, lies above no face of the bridge",
        std::ranges::max_element(fill.surface, {}, [](const Point& point) { return point.y(); })->y()));
  }
  return notes;
}

}  // namespace voussoir
