#include "lookup/readings/sensors_file.h"

#include <algorithm>
#include <array>
#include <optional>

#include "core/error.h"
#include "core/text.h"
#include "lookup/readings/csv_text.h"
#include "lookup/readings/decimal_mark.h"
#include "lookup/readings/text_input.h"

namespace voussoir {
namespace {

constexpr std::string_view kColumns = "name, quantity; x_m, y_m; optionally x2_m, y2_m, block, block2";
constexpr std::string_view kQuantities = "ux, uy, tilt or distance";

enum Column : std::size_t { kName, kQuantity, kX, kY, kX2, kY2, kBlock, kBlock2, kColumnCount };
constexpr std::array<std::string_view, kColumnCount> kNames = {"name", "quantity", "x_m",   "y_m",
                                                               "x2_m", "y2_m",     "block", "block2"};

std::optional<Quantity> parse_quantity(std::string_view text) {
  if (text == "ux") return Quantity::ux;
  if (text == "uy") return Quantity::uy;
  if (text == "tilt") return Quantity::tilt;
  if (text == "distance") return Quantity::distance;
  return std::nullopt;
}

/// Whether a place is in a block or at most kPlaceTolerance away from it.
bool touches(const Polygon& polygon, const Point& place) {
  bool inside = false;  // an odd number of edges crosses the way from the place to the right
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point& a = polygon[i];
    const Point& b = polygon[(i + 1) % polygon.size()];
    if ((a.y() > place.y()) == (b.y() > place.y())) continue;
    if (place.x() < a.x() + (place.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside || distance_to_boundary(polygon, place) <= kPlaceTolerance;
}

class SensorsReader {
 public:
  SensorsReader(const CsvTable& table, const BlockLayout& layout, const Mesh& mesh)
      : table_(table), layout_(layout), mesh_(mesh) {
    columns_.fill(kNone);
    for (std::size_t i = 0; i < table.header.fields.size(); ++i) read_column(i);
    if (columns_[kName] == kNone || columns_[kQuantity] == kNone)
      table.fail(table.header.number, fmt::format("no column name or no quantity, expected {}", kColumns));
    std::vector<std::size_t> numbers;
    for (const Column column : {kX, kY, kX2, kY2})
      if (columns_[column] != kNone) numbers.push_back(columns_[column]);
    mark_ = decimal_mark_of(table, numbers);
  }

  Sensor read(const CsvLine& line) const {
    const std::string label = text(line, kName);
    if (label.empty()) table_.fail(line.number, "a sensor without a name, expected one");
    const std::optional<Quantity> read_quantity = parse_quantity(text(line, kQuantity));
    if (!read_quantity)
      table_.fail(line.number, fmt::format("unknown quantity {}, expected {}",
                                           in_quotes(text(line, kQuantity)), kQuantities));
    if (*read_quantity == Quantity::distance) return distance_sensor(line, label);
    for (const Column column : {kX2, kY2, kBlock2})
      if (!text(line, column).empty())
        table_.fail(line.number, fmt::format("{} in column {}, expected nothing but for a distance",
                                             in_quotes(text(line, column)), kNames[column]));
    if (*read_quantity == Quantity::tilt) return tilt_sensor(line, label);
    const Place at = place(line, kX, kY, kBlock);
    const Point direction = *read_quantity == Quantity::ux ? Point(1.0, 0.0) : Point(0.0, 1.0);
    return {label, *read_quantity, at.position, {at.block}, displacement_weights(at, direction, mesh_)};
  }

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  void read_column(std::size_t position) {
    const std::string& header = table_.header.fields[position];
    const auto found = std::find(kNames.begin(), kNames.end(), header);
    if (found == kNames.end())
      table_.fail(table_.header.number,
                  fmt::format("unknown column {}, expected {}", in_quotes(header), kColumns));
    std::size_t& column = columns_[static_cast<std::size_t>(found - kNames.begin())];
    if (column != kNone)
      table_.fail(table_.header.number,
                  fmt::format("column {} is given twice, expected {}", in_quotes(header), kColumns));
    column = position;
  }

  std::string text(const CsvLine& line, Column column) const {
    return columns_[column] == kNone ? std::string() : line.fields[columns_[column]];
  }

  Sensor tilt_sensor(const CsvLine& line, const std::string& label) const {
    const bool placed = !text(line, kX).empty() || !text(line, kY).empty();
    const std::optional<BlockId> named = named_block(line, kBlock);
    if (!placed && !named)
      table_.fail(line.number, "a tilt without place and without block, expected one of them");
    const BlockId of = placed ? place(line, kX, kY, kBlock).block : *named;
    return {label, Quantity::tilt, centroid(layout_[of].polygon), {of}, rotation_weights(of, mesh_)};
  }

  Sensor distance_sensor(const CsvLine& line, const std::string& label) const {
    const Place from = place(line, kX, kY, kBlock);
    const Place to = place(line, kX2, kY2, kBlock2);
    if ((to.position - from.position).norm() <= kPlaceTolerance)
      table_.fail(line.number, fmt::format("a distance between places that are one, expected more than {} m",
                                           kPlaceTolerance));
    std::vector<BlockId> blocks{from.block};
    if (to.block != from.block) blocks.push_back(to.block);
    return {label, Quantity::distance, 0.5 * (from.position + to.position), std::move(blocks),
            distance_weights(from, to, mesh_)};
  }

  Place place(const CsvLine& line, Column x_column, Column y_column, Column block_column) const {
    const double at_x = coordinate(line, x_column);
    const Point at(at_x, coordinate(line, y_column));
    std::vector<BlockId> blocks;
    for (std::size_t i = 0; i < layout_.size(); ++i)
      if (touches(layout_.blocks[i].polygon, at)) blocks.push_back(BlockId{static_cast<std::int32_t>(i)});
    if (blocks.empty())
      table_.fail(line.number,
                  fmt::format("x = {} m, y = {} m is outside the bridge, expected a place on a block", at.x(),
                              at.y()));
    const std::optional<BlockId> named = named_block(line, block_column);
    if (named && std::find(blocks.begin(), blocks.end(), *named) == blocks.end())
      table_.fail(line.number, fmt::format("x = {} m, y = {} m is not on block {}, expected {}", at.x(),
                                           at.y(), layout_[*named].label, labels(blocks)));
    if (!named && blocks.size() > 1)
      table_.fail(line.number, fmt::format("blocks meet at x = {} m, y = {} m, expected {} in column {}",
                                           at.x(), at.y(), labels(blocks), kNames[block_column]));
    return {at, named.value_or(blocks.front())};
  }

  std::string labels(const std::vector<BlockId>& blocks) const {
    std::string result;
    for (const BlockId id : blocks) result += (result.empty() ? "" : " or ") + layout_[id].label;
    return result;
  }

  double coordinate(const CsvLine& line, Column column) const {
    const std::string field = text(line, column);
    const std::optional<double> number = parse_number(field, mark_);
    if (!number)
      table_.fail(line.number, fmt::format("{} is no coordinate, expected a number in metres in column {}",
                                           in_quotes(field), kNames[column]));
    return *number;
  }

  std::optional<BlockId> named_block(const CsvLine& line, Column column) const {
    const std::string field = text(line, column);
    if (field.empty()) return std::nullopt;
    try {
      const Scene scene = parse_scene(field, layout_);
      if (scene.missing() == 1) return scene.removed.front();
    } catch (const InputError& error) {
      table_.fail(line.number, error.what());
    }
    table_.fail(line.number,
                fmt::format("{} in column {}, expected one block", in_quotes(field), kNames[column]));
  }

  const CsvTable& table_;
  const BlockLayout& layout_;
  const Mesh& mesh_;
  std::array<std::size_t, kColumnCount> columns_{};
  DecimalMark mark_ = DecimalMark::point;
};

}  // namespace

void parse_sensors(std::string_view text, const std::string& name, const BlockLayout& layout,
                   const Mesh& mesh, SensorList& list) {
  const CsvTable table = read_csv(text, name, kColumns);
  const SensorsReader reader(table, layout, mesh);
  for (const CsvLine& line : table.rows) {
    Sensor sensor = reader.read(line);
    const auto same = [&](const Sensor& other) { return other.name == sensor.name; };
    if (std::any_of(list.sensors.begin(), list.sensors.end(), same))
      table.fail(line.number,
                 fmt::format("sensor {} is there already, expected another name", in_quotes(sensor.name)));
    list.sensors.push_back(std::move(sensor));
  }
}

void read_sensors(const std::filesystem::path& path, const BlockLayout& layout, const Mesh& mesh,
                  SensorList& list) {
  parse_sensors(read_text_input(path, "a CSV file of sensors"), input_name(path), layout, mesh, list);
}

}  // namespace voussoir
