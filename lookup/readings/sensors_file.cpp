#include "lookup/readings/sensors_file.h"

#include <algorithm>
#include <array>
#include <optional>

#include "core/error.h"
#include "core/structure/placed_sensor.h"
#include "core/text.h"
#include "lookup/readings/csv_text.h"
#include "lookup/readings/decimal_mark.h"
#include "lookup/readings/text_input.h"

namespace voussoir {
namespace {

constexpr std::string_view kColumns = "name, quantity; x_m, y_m; optionally x2_m, y2_m, block, block2";

enum Column : std::size_t { kName, kQuantity, kX, kY, kX2, kY2, kBlock, kBlock2, kColumnCount };
constexpr std::array<std::string_view, kColumnCount> kNames = {"name", "quantity", "x_m",   "y_m",
                                                               "x2_m", "y2_m",     "block", "block2"};

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
    const std::optional<Quantity> quantity = parse_quantity(text(line, kQuantity));
    if (!quantity)
      table_.fail(line.number, fmt::format("unknown quantity {}, expected {}",
                                           in_quotes(text(line, kQuantity)), kQuantities));
    const SensorDescription described{.name = label,
                                      .quantity = *quantity,
                                      .from = place(line, kX, kY),
                                      .to = place(line, kX2, kY2),
                                      .block = text(line, kBlock),
                                      .to_block = text(line, kBlock2)};
    try {
      PlacedSensor placed = place_sensor(described, layout_, mesh_);
      return {label, *quantity, placed.position, std::move(placed.blocks), std::move(placed.weights)};
    } catch (const InputError& error) {
      table_.fail(line.number, error.what());
    }
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

  /// Nothing if both fields are empty.
  std::optional<Point> place(const CsvLine& line, Column x_column, Column y_column) const {
    if (text(line, x_column).empty() && text(line, y_column).empty()) return std::nullopt;
    const double x = coordinate(line, x_column);
    return Point(x, coordinate(line, y_column));
  }

  double coordinate(const CsvLine& line, Column column) const {
    const std::string field = text(line, column);
    const std::optional<double> number = parse_number(field, mark_);
    if (!number)
      table_.fail(line.number, fmt::format("{} is no coordinate, expected a number in metres in column {}",
                                           in_quotes(field), kNames[column]));
    return *number;
  }

  const CsvTable& table_;
  const BlockLayout& layout_;
  const Mesh& mesh_;
  std::array<std::size_t, kColumnCount> columns_{};
  DecimalMark mark_ = DecimalMark::point;
};

}  // namespace

SensorList parse_sensors(std::string_view text, const std::string& name, const BlockLayout& layout,
                         const Mesh& mesh, SensorList list) {
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
  return list;
}

SensorList read_sensors(const std::filesystem::path& path, const BlockLayout& layout, const Mesh& mesh,
                        SensorList list) {
  return parse_sensors(read_text_input(path, "a CSV file of sensors"), input_name(path), layout, mesh,
                       std::move(list));
}

SensorList all_sensors(const Database& database, const std::optional<std::filesystem::path>& file) {
  SensorList own = control_point_sensors(database.control_points());
  return file ? read_sensors(*file, database.layout(), database.mesh(), std::move(own)) : own;
}

}  // namespace voussoir
