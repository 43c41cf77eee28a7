#include "core/structure/placed_sensor.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "core/geometry/polygon.h"
#include "core/structure/scene.h"
#include "core/text.h"

namespace voussoir {
namespace {

/// Whether a place is in a block or at most kPlaceTolerance away from it.
bool touches(const Polygon& polygon, const Point& place) {
  return contains(polygon, place) || distance_to_boundary(polygon, place) <= kPlaceTolerance;
}

std::optional<BlockId> named_block(const std::string& text, const BlockLayout& layout) {
  if (text.empty()) return std::nullopt;
  const Scene scene = parse_scene(text, layout);
  if (scene.missing() != 1) throw InputError(fmt::format("{}: expected one block", in_quotes(text)));
  return scene.removed.front();
}

std::string labels(const std::vector<BlockId>& blocks, const BlockLayout& layout) {
  std::string result;
  for (const BlockId id : blocks) result += (result.empty() ? "" : " or ") + layout[id].label;
  return result;
}

/// `key` is what names the block, for messages.
Place place_of(const std::optional<Point>& given, const std::string& block, const char* key,
               const BlockLayout& layout) {
  if (!given) throw InputError("no place, expected x_m and y_m, of a distance x2_m and y2_m, too");
  const Point& at = *given;
  std::vector<BlockId> blocks;
  for (std::size_t i = 0; i < layout.size(); ++i)
    if (touches(layout.blocks[i].polygon, at)) blocks.push_back(BlockId{static_cast<std::int32_t>(i)});
  if (blocks.empty())
    throw InputError(
        fmt::format("x = {} m, y = {} m is outside the bridge, expected a place on a block", at.x(), at.y()));
  const std::optional<BlockId> named = named_block(block, layout);
  if (named && std::ranges::find(blocks, *named) == blocks.end())
    throw InputError(fmt::format("x = {} m, y = {} m is not on block {}, expected {}", at.x(), at.y(),
                                 layout[*named].label, labels(blocks, layout)));
  if (!named && blocks.size() > 1)
    throw InputError(fmt::format("blocks meet at x = {} m, y = {} m, expected {} as {}", at.x(), at.y(),
                                 labels(blocks, layout), key));
  return {at, named.value_or(blocks.front())};
}

PlacedSensor place_tilt(const SensorDescription& sensor, const BlockLayout& layout, const Mesh& mesh) {
  const std::optional<BlockId> named = named_block(sensor.block, layout);
  if (!sensor.from && !named)
    throw InputError("a tilt without place and without block, expected one of them");
  const BlockId of = sensor.from ? place_of(sensor.from, sensor.block, "block", layout).block : *named;
  return {centroid(layout[of].polygon), {of}, rotation_weights(of, mesh)};
}

PlacedSensor place_distance(const SensorDescription& sensor, const BlockLayout& layout, const Mesh& mesh) {
  const Place from = place_of(sensor.from, sensor.block, "block", layout);
  const Place to = place_of(sensor.to, sensor.to_block, "block2", layout);
  if ((to.position - from.position).norm() <= kPlaceTolerance)
    throw InputError(
        fmt::format("a distance between places that are one, expected more than {} m", kPlaceTolerance));
  std::vector<BlockId> blocks{from.block};
  if (to.block != from.block) blocks.push_back(to.block);
  return {0.5 * (from.position + to.position), std::move(blocks), distance_weights(from, to, mesh)};
}

}  // namespace

PlacedSensor place_sensor(const SensorDescription& sensor, const BlockLayout& layout, const Mesh& mesh) {
  if (sensor.quantity == Quantity::distance) return place_distance(sensor, layout, mesh);
  if (sensor.to || !sensor.to_block.empty())
    throw InputError("a second place or block, expected none but of a distance");
  if (sensor.quantity == Quantity::tilt) return place_tilt(sensor, layout, mesh);
  const Place at = place_of(sensor.from, sensor.block, "block", layout);
  const Point direction = sensor.quantity == Quantity::ux ? Point(1.0, 0.0) : Point(0.0, 1.0);
  return {at.position, {at.block}, displacement_weights(at, direction, mesh)};
}

}  // namespace voussoir
