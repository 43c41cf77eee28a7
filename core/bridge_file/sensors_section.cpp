#include "core/bridge_file/sensors_section.h"

#include <algorithm>
#include <cctype>

namespace voussoir {
namespace {

/// Names stand in tables and lists with commas.
bool is_name(const std::string& text) {
  const auto allowed = [](unsigned char c) {
    return c < 128 && (std::isalnum(c) != 0 || c == '-' || c == '_' || c == '.');
  };
  return !text.empty() && text.size() <= kLongestSensorName && std::ranges::all_of(text, allowed);
}

std::optional<Point> read_place(TomlSection& section, const char* x_key, const char* y_key) {
  if (!section.has(x_key) && !section.has(y_key)) {
    section.know(x_key);
    section.know(y_key);
    return std::nullopt;
  }
  section.require(x_key);
  section.require(y_key);
  Point place = Point::Zero();
  section.number(x_key, place.x(), -kLargestLength, kLargestLength);
  section.number(y_key, place.y(), -kLargestLength, kLargestLength);
  return place;
}

SensorDescription read_sensor(TomlSection section) {
  SensorDescription sensor;
  section.require("name");
  section.text("name", sensor.name);
  if (!is_name(sensor.name))
    section.refuse("name",
                   fmt::format("expected at most {} letters, digits, -, _ and .", kLongestSensorName));
  section.choice("quantity", sensor.quantity, quantity_names());
  sensor.from = read_place(section, "x_m", "y_m");
  sensor.to = read_place(section, "x2_m", "y2_m");
  section.text("block", sensor.block);
  section.text("block2", sensor.to_block);
  section.refuse_unknown_keys();
  return sensor;
}

}  // namespace

std::vector<SensorDescription> read_sensors(const toml::array& tables, const std::string& file) {
  if (tables.size() > kMostSensors)
    throw InputError(at_line(file, static_cast<long>(tables.source().begin.line),
                             fmt::format("{} sensors: expected at most {}", tables.size(), kMostSensors)));
  std::vector<SensorDescription> sensors;
  for (const toml::node& node : tables)
    sensors.push_back(read_sensor(TomlSection(file, node.as_table(), " in [[sensors]]")));
  return sensors;
}

}  // namespace voussoir
