#include "lookup/readings/measurements.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <memory>

#include "core/error.h"
#include "core/text.h"
#include "lookup/readings/csv_text.h"

namespace voussoir {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kMetresPerMillimetre = 1e-3;
constexpr std::size_t kLargestFile = 4U << 20U;  // [bytes] far beyond any number of sensors
constexpr double kSamePlace = 1e-6;              // [m] points closer than this share a place
constexpr std::string_view kColumns =
    "point or x_m,y_m; one of uy_mm, uy_m, settlement_mm; optionally sigma_mm";

struct ValueColumn {
  std::string_view name;
  double factor;  // from the column's unit and sign to metres, up positive
};
constexpr std::array<ValueColumn, 3> kValueColumns = {
    {{"uy_mm", kMetresPerMillimetre}, {"uy_m", 1.0}, {"settlement_mm", -kMetresPerMillimetre}}};

constexpr std::size_t kAbsent = std::numeric_limits<std::size_t>::max();

/// Nothing, or what programs write where they have no number.
bool says_nothing(std::string_view text) {
  return text.empty() || text == "NaN" || text == "nan" || text == "NAN" || text == "-nan";
}

/// Which field of a row holds what.
struct Columns {
  std::size_t point = kAbsent;
  std::size_t x = kAbsent;
  std::size_t y = kAbsent;
  std::size_t value = kAbsent;
  std::size_t sigma = kAbsent;
  std::size_t count = 0;
  double factor = 1.0;
};

class Reader {
 public:
  Reader(std::string name, const std::vector<StoredPoint>& points) : name_(std::move(name)), points_(points) {
    result_.displacement.assign(points.size(), kNan);
    result_.sigma.assign(points.size(), kNan);
    result_.silent.assign(points.size(), false);
    line_of_point_.assign(points.size(), 0);
  }

  Measurements read(std::string_view text) {
    check_encoding(text);
    const std::vector<CsvLine> lines = cut_csv(text);
    if (lines.empty()) fail(0, fmt::format("the file is empty, expected a header line ({})", kColumns));
    read_header(lines.front());
    for (std::size_t i = 1; i < lines.size(); ++i) read_row(lines[i]);
    if (result_.count() == 0)
      fail(0, "no usable row, expected at least one control point with a displacement");
    return std::move(result_);
  }

 private:
  [[noreturn]] void fail(long line, const std::string& message) const {
    throw InputError(at_line(name_, line, message));
  }

  void check_encoding(std::string_view text) const {
    if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
      fail(1, "the file is UTF-16, expected UTF-8 (save it as plain CSV)");
    if (text.find('\0') != std::string_view::npos) fail(1, "the file holds binary data, expected CSV");
  }

  void claim(std::size_t& column, std::size_t position, const CsvLine& header) const {
    if (column != kAbsent)
      fail(header.number, fmt::format("column {} is given twice or beside another value column, expected {}",
                                      quoted(header.fields[position]), kColumns));
    column = position;
  }

  void read_column(const CsvLine& header, std::size_t position) {
    const std::string_view name = header.fields[position];
    const auto value = std::find_if(kValueColumns.begin(), kValueColumns.end(),
                                    [&](const ValueColumn& column) { return column.name == name; });
    if (value != kValueColumns.end()) {
      claim(columns_.value, position, header);
      columns_.factor = value->factor;
      return;
    }
    std::size_t* const column = name == "point"      ? &columns_.point
                                : name == "x_m"      ? &columns_.x
                                : name == "y_m"      ? &columns_.y
                                : name == "sigma_mm" ? &columns_.sigma
                                                     : nullptr;
    if (column == nullptr)
      fail(header.number, fmt::format("unknown column {}, expected {}", quoted(name), kColumns));
    claim(*column, position, header);
  }

  void read_header(const CsvLine& header) {
    columns_.count = header.fields.size();
    for (std::size_t position = 0; position < header.fields.size(); ++position) read_column(header, position);
    const bool named = columns_.point != kAbsent;
    const bool placed = columns_.x != kAbsent && columns_.y != kAbsent;
    const bool half_placed = (columns_.x != kAbsent) != (columns_.y != kAbsent);
    if (named == placed || half_placed)
      fail(header.number, fmt::format("no single way to name a point, expected {}", kColumns));
    if (columns_.value == kAbsent) fail(header.number, fmt::format("no value column, expected {}", kColumns));
  }

  void read_row(const CsvLine& line) {
    if (line.fields.size() != columns_.count)
      fail(line.number,
           fmt::format("{} values, expected {} as in the header", line.fields.size(), columns_.count));
    const std::size_t point = columns_.point != kAbsent ? named_point(line) : placed_point(line);
    if (line_of_point_[point] != 0)
      fail(line.number, fmt::format("point {} is given again, expected each point once (first in line {})",
                                    points_[point].name, line_of_point_[point]));
    line_of_point_[point] = line.number;
    result_.displacement[point] = displacement(line);
    result_.silent[point] = std::isnan(result_.displacement[point]);
    if (columns_.sigma != kAbsent) result_.sigma[point] = sigma(line);
  }

  std::size_t named_point(const CsvLine& line) const {
    const std::string_view name = line.fields[columns_.point];
    const auto found = std::find_if(points_.begin(), points_.end(),
                                    [&](const StoredPoint& point) { return point.name == name; });
    if (found == points_.end())
      fail(line.number, fmt::format("unknown point {}, expected {} to {}", quoted(name), points_.front().name,
                                    points_.back().name));
    return static_cast<std::size_t>(found - points_.begin());
  }

  /// The nearest point; of several at the same place the first that has no row yet.
  std::size_t placed_point(const CsvLine& line) const {
    const Point place(coordinate(line, columns_.x), coordinate(line, columns_.y));
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < points_.size(); ++i) {
      const double gain = (points_[nearest].position - place).norm() - (points_[i].position - place).norm();
      const bool twin =
          std::abs(gain) <= kSamePlace && line_of_point_[nearest] != 0 && line_of_point_[i] == 0;
      if (gain > kSamePlace || twin) nearest = i;
    }
    const double distance = (points_[nearest].position - place).norm();
    if (distance > kPointTolerance)
      fail(line.number,
           fmt::format("no control point at x = {} m, y = {} m: the nearest, {}, is {:.3g} m away, "
                       "expected at most {} m",
                       place.x(), place.y(), points_[nearest].name, distance, kPointTolerance));
    return nearest;
  }

  double coordinate(const CsvLine& line, std::size_t column) const {
    const std::optional<double> number = parse_number(line.fields[column]);
    if (!number)
      fail(line.number,
           fmt::format("{} is no coordinate, expected a number in metres", quoted(line.fields[column])));
    return *number;
  }

  double displacement(const CsvLine& line) const {
    const std::string_view text = line.fields[columns_.value];
    if (says_nothing(text)) return kNan;
    const std::optional<double> number = parse_number(text);
    if (!number)
      fail(line.number,
           fmt::format("{} is no finite number, expected a displacement or nothing", quoted(text)));
    const double metres = columns_.factor * *number;
    if (std::abs(metres) > kLargestDisplacement)
      fail(line.number,
           fmt::format("{} is a displacement of {:.3g} m, expected at most {} m (check the units)",
                       quoted(text), std::abs(metres), kLargestDisplacement));
    return metres;
  }

  double sigma(const CsvLine& line) const {
    const std::string_view text = line.fields[columns_.sigma];
    if (says_nothing(text)) return kNan;
    const std::optional<double> number = parse_number(text);
    if (!number || *number <= 0.0)
      fail(line.number,
           fmt::format("{} is no sigma, expected a positive number of millimetres or nothing", quoted(text)));
    return kMetresPerMillimetre * *number;
  }

  std::string name_;
  const std::vector<StoredPoint>& points_;
  Columns columns_;
  Measurements result_;
  std::vector<long> line_of_point_;  // 0: not yet given
};

std::string read_text(const std::filesystem::path& path, const std::string& name) {
  const auto failed = [&] {
    return InputError(at_line(
        name, 0,
        fmt::format("cannot be read ({}), expected a CSV file of measurements", std::strerror(errno))));
  };
  const bool standard_input = path == "-";
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(
      std::fopen(standard_input ? "/dev/stdin" : path.c_str(), "rb"), &std::fclose);
  if (!file) throw failed();
  std::string text;
  std::array<char, 16384> chunk{};
  for (std::size_t got = 1; got > 0 && text.size() <= kLargestFile; text.append(chunk.data(), got))
    got = std::fread(chunk.data(), 1, chunk.size(), file.get());
  if (std::ferror(file.get()) != 0) throw failed();
  if (text.size() > kLargestFile)
    throw InputError(
        at_line(name, 0,
                fmt::format("larger than {} MiB, expected a CSV file of measurements", kLargestFile >> 20U)));
  return text;
}

}  // namespace

std::size_t Measurements::count() const {
  return static_cast<std::size_t>(std::count_if(displacement.begin(), displacement.end(),
                                                [](double value) { return !std::isnan(value); }));
}

Measurements as_measurements(std::span<const double> displacements) {
  Measurements result{
      {displacements.begin(), displacements.end()}, std::vector<double>(displacements.size(), kNan), {}};
  for (const double value : displacements) result.silent.push_back(std::isnan(value));
  return result;
}

Measurements parse_measurements(std::string_view text, const std::string& name,
                                const std::vector<StoredPoint>& points) {
  return Reader(name, points).read(text);
}

Measurements read_measurements(const std::filesystem::path& path, const std::vector<StoredPoint>& points) {
  const std::string name = path == "-" ? "standard input" : path.string();
  return parse_measurements(read_text(path, name), name, points);
}

}  // namespace voussoir
