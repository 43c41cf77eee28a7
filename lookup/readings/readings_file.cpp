#include "lookup/readings/readings_file.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <span>

#include "core/error.h"
#include "core/not_a_number.h"
#include "core/text.h"
#include "core/units.h"
#include "lookup/readings/readings_columns.h"
#include "lookup/readings/stated_sigmas.h"
#include "lookup/readings/text_input.h"

namespace voussoir {
namespace {

constexpr double kSamePlace = 1e-6;  // [m] points closer than this share a place
constexpr std::size_t kMostLevellings = 50;
constexpr double kFarAway = std::numeric_limits<double>::max();

/// Nothing, or what programs write where they have no number.
bool says_nothing(std::string_view text) {
  return text.empty() || text == "NaN" || text == "nan" || text == "NAN" || text == "-nan";
}

/// -9999, 99999, -999.9: nothing but nines, three and more before the decimal mark; -999.25 and 16 bits. A
/// height may be 9999 mm.
bool is_placeholder(double number, bool is_height) {
  if (number == -999.25 || number == -32768.0) return true;
  const std::string digits = fmt::format("{}", std::abs(number));
  const std::size_t whole = std::min(digits.find('.'), digits.size());
  return whole >= 3 && digits.find_first_not_of("9.") == std::string::npos && (number < 0.0 || !is_height);
}

class ReadingsReader {
 public:
  ReadingsReader(const CsvTable& table, const SensorList& list)
      : table_(table),
        sensors_(list.sensors),
        control_points_(list.control_points),
        columns_(find_readings_columns(table)) {}

  ReadingsFile read() {
    ReadingsFile file{table_.file, columns_.kind(), columns_.two_epochs(), {}};
    for (const CsvLine& line : table_.rows) file.readings.push_back(read_row(line));
    const auto has_value = [](const Reading& reading) { return !std::isnan(reading.value); };
    if (std::none_of(file.readings.begin(), file.readings.end(), has_value))
      table_.fail(0, columns_.two_epochs()
                         ? "no usable row, expected at least one point with a value before and after"
                         : "no usable row, expected at least one point with a displacement");
    return file;
  }

 private:
  Reading read_row(const CsvLine& line) {
    Reading reading{.line = line.number, .load = load(line), .before = kNan, .after = kNan};
    reading.sensor = columns_.point != kAbsent ? named_sensor(line) : placed_point(line, reading.load);
    if (has_place_beside_name(line)) check_place(line, sensors_[reading.sensor]);
    const auto [first, is_new] = line_of_.try_emplace({reading.sensor, reading.load}, line.number);
    if (!is_new)
      table_.fail(line.number,
                  fmt::format("point {} is given again, expected each point once{} (first in line {})",
                              sensors_[reading.sensor].name, reading.load.empty() ? "" : " under a load",
                              first->second));
    read_value(line, reading);
    reading.sigma = columns_.sigma != kAbsent ? sigma(line) : kNan;
    if (columns_.levelling != kAbsent) reading.levelling = levelling(line);
    return reading;
  }

  void read_value(const CsvLine& line, Reading& reading) const {
    if (!columns_.two_epochs()) {
      reading.value = displacement(line, columns_.value, kLargestDisplacement);
      reading.silent = std::isnan(reading.value);
      return;
    }
    reading.before = displacement(line, columns_.before, kLargestHeight);
    reading.after = displacement(line, columns_.after, kLargestHeight);
    reading.value = reading.after - reading.before;
    check_size(line,
               fmt::format("from {} to {}", in_quotes(line.fields[columns_.before]),
                           in_quotes(line.fields[columns_.after])),
               reading.value, kLargestDisplacement);
    reading.silent = std::isnan(reading.after) && !std::isnan(reading.before);
  }

  std::string load(const CsvLine& line) const {
    if (columns_.load == kAbsent) return {};
    const std::string& name = line.fields[columns_.load];
    if (name.empty())
      table_.fail(line.number,
                  "no load in this row, expected one, as all readings of a file are of one kind");
    return name;
  }

  std::string levelling(const CsvLine& line) {
    const std::string& name = line.fields[columns_.levelling];
    levellings_.insert(name);
    if (levellings_.size() > kMostLevellings)
      table_.fail(line.number, fmt::format("{} is another levelling, expected at most {} in a file",
                                           in_quotes(name), kMostLevellings));
    return name;
  }

  std::size_t named_sensor(const CsvLine& line) const {
    const std::string& name = line.fields[columns_.point];
    const auto found = std::find_if(sensors_.begin(), sensors_.end(),
                                    [&](const Sensor& sensor) { return sensor.name == name; });
    if (found == sensors_.end())
      table_.fail(
          line.number,
          fmt::format("unknown point {}, expected {}{}", in_quotes(name),
                      names_in_words(names_of(std::span(sensors_).first(control_points_))),
                      sensors_.size() > control_points_ ? ", or a sensor of the list"
                                                        : ", or a sensor of a file that --sensors names"));
    if (found->quantity != Quantity::uy && columns_.vertical_only)
      table_.fail(
          line.number,
          fmt::format("sensor {} reads no vertical displacement, expected a column value_mm, change_mm, "
                      "or before_mm,after_mm",
                      name));
    return static_cast<std::size_t>(found - sensors_.begin());
  }

  /// The nearest control point, or sensor of vertical displacements; of several at the same place the first
  /// that has no row yet.
  std::size_t placed_point(const CsvLine& line, const std::string& load) const {
    const double x = coordinate(line, columns_.x);
    const Point place(x, coordinate(line, columns_.y));
    const auto distance = [&](std::size_t i) {
      return sensors_[i].quantity == Quantity::uy ? (sensors_[i].position - place).norm() : kFarAway;
    };
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < control_points_; ++i) {
      const double gain = distance(nearest) - distance(i);
      const bool twin =
          std::abs(gain) <= kSamePlace && line_of_.contains({nearest, load}) && !line_of_.contains({i, load});
      if (gain > kSamePlace || twin) nearest = i;
    }
    if (distance(nearest) == kFarAway)
      table_.fail(line.number,
                  "no sensor of vertical displacements in the database, expected sensors by name in a column "
                  "point");
    if (distance(nearest) > kPointTolerance)
      table_.fail(
          line.number,
          fmt::format("no control point at x = {} m, y = {} m: the nearest, {}, is {:.3g} m away, "
                      "expected at most {} m",
                      place.x(), place.y(), sensors_[nearest].name, distance(nearest), kPointTolerance));
    return nearest;
  }

  bool has_place_beside_name(const CsvLine& line) const {
    return columns_.point != kAbsent && columns_.x != kAbsent &&
           !(line.fields[columns_.x].empty() && line.fields[columns_.y].empty());
  }

  /// Where rows give a point's coordinates beside its name, neither is taken for another's. Tilts and
  /// distances are of whole blocks: their places may be said to be anywhere.
  void check_place(const CsvLine& line, const Sensor& sensor) const {
    if (sensor.quantity != Quantity::uy && sensor.quantity != Quantity::ux) return;
    const Point place(coordinate(line, columns_.x), coordinate(line, columns_.y));
    if ((sensor.position - place).norm() > kPointTolerance)
      table_.fail(
          line.number,
          fmt::format(
              "x = {} m, y = {} m is not where {} is, expected x = {:.6g} m, y = {:.6g} m within {} m",
              place.x(), place.y(), sensor.name, sensor.position.x(), sensor.position.y(), kPointTolerance));
  }

  double coordinate(const CsvLine& line, std::size_t column) const {
    const std::optional<double> number = parse_number(line.fields[column], columns_.mark);
    if (!number)
      table_.fail(line.number, fmt::format("{} is no coordinate, expected a number in metres",
                                           in_quotes(line.fields[column])));
    return *number;
  }

  double displacement(const CsvLine& line, std::size_t column, double largest) const {
    const std::string& text = line.fields[column];
    if (says_nothing(text)) return kNan;
    const std::optional<double> number = parse_number(text, columns_.mark);
    if (!number)
      table_.fail(line.number,
                  fmt::format("{} is no finite number, expected a displacement or nothing", in_quotes(text)));
    if (is_placeholder(*number, largest == kLargestHeight))
      table_.fail(line.number, fmt::format("{} is what loggers write where there is no reading, expected a "
                                           "displacement or nothing",
                                           in_quotes(text)));
    const double metres = columns_.factor * *number;
    check_size(line, in_quotes(text), metres, largest);
    return metres;
  }

  void check_size(const CsvLine& line, const std::string& what, double metres, double largest) const {
    if (std::abs(metres) > largest)
      table_.fail(line.number, fmt::format("{} is a {} of {:.3g} m, expected at most {} m (check the units)",
                                           what, largest == kLargestHeight ? "height" : "displacement",
                                           std::abs(metres), largest));
  }

  double sigma(const CsvLine& line) const {
    const std::string& text = line.fields[columns_.sigma];
    if (says_nothing(text)) return kNan;
    const std::optional<double> number = parse_number(text, columns_.mark);
    const bool in_metres = columns_.sigma_factor == 1.0;
    const double unit = in_metres ? kMillimetres : 1.0;  // [mm]
    if (!number || !(*number >= kSmallestSigma / unit && *number <= kLargestSigma / unit))
      table_.fail(line.number, fmt::format("{} is no sigma, expected {} from {:g} to {:g}, or nothing",
                                           in_quotes(text), in_metres ? "metres" : "millimetres",
                                           kSmallestSigma / unit, kLargestSigma / unit));
    return columns_.sigma_factor * *number;
  }

  const CsvTable& table_;
  const std::vector<Sensor>& sensors_;
  std::size_t control_points_;
  ReadingsColumns columns_;
  std::map<std::pair<std::size_t, std::string>, long> line_of_;  // of each sensor under each load
  std::set<std::string> levellings_;
};

}  // namespace

ReadingsFile parse_readings(std::string_view text, const std::string& name, const SensorList& list) {
  const CsvTable table = read_csv(text, name, kReadingsColumns);
  return ReadingsReader(table, list).read();
}

ReadingsText read_readings(const std::filesystem::path& path) {
  return {read_text_input(path, "a CSV file of measurements"), input_name(path)};
}

}  // namespace voussoir
