#include "lookup/readings/readings_columns.h"

#include <algorithm>
#include <array>

#include "core/error.h"
#include "core/text.h"
#include "core/units.h"

namespace voussoir {
namespace {

struct ValueColumn {
  std::string_view quantity;
  double sign;  // of what is up
  bool change;
  bool vertical_only;
};
constexpr std::array<ValueColumn, 4> kValueColumns = {{{"uy", 1.0, false, true},
                                                       {"settlement", -1.0, false, true},
                                                       {"value", 1.0, false, false},
                                                       {"change", 1.0, true, false}}};

/// "change_mm": a change in units of 0.001 m.
struct Measured {
  std::string_view quantity;
  double unit;  // [m]; 0 without one
};
Measured measured_in(std::string_view name) {
  for (const auto& [ending, unit] :
       {std::pair<std::string_view, double>{"_mm", kMetresPerMillimetre}, {"_m", 1.0}})
    if (name.ends_with(ending)) return {name.substr(0, name.size() - ending.size()), unit};
  return {name, 0.0};
}

/// Of a column that is not read.
constexpr std::string_view kRemark = "remark";

/// What surveys have beside readings, and what to do about it.
std::string_view advice_on(std::string_view name) {
  if (name.starts_with("temp"))
    return " (readings that are corrected for temperature are asked with --conditions known; else it is "
           "uncertain as the bridge file states, and the column may be called remark)";
  if (name.ends_with("_mrad") || name.ends_with("_rad"))
    return " (tilts are read in mm per m, which is mrad, in a column such as change_mm)";
  if (name.starts_with("date") || name.starts_with("time")) return " (what is not read may be called remark)";
  return "";
}

class Header {
 public:
  explicit Header(const CsvTable& table) : table_(table) {}

  ReadingsColumns read() {
    for (std::size_t position = 0; position < names().size(); ++position) read_column(position);
    check_point();
    check_value();
    return columns_;
  }

 private:
  const std::vector<std::string>& names() const { return table_.header.fields; }

  [[noreturn]] void fail(const std::string& what) const {
    table_.fail(table_.header.number, fmt::format("{}, expected {}", what, kReadingsColumns));
  }

  void claim(std::size_t& column, std::size_t position) const {
    if (column != kAbsent)
      fail(fmt::format("column {} is given twice or beside another value column",
                       in_quotes(names()[position])));
    column = position;
  }

  void read_column(std::size_t position) {
    const std::string& name = names()[position];
    if (name == kRemark) return;
    const auto [quantity, unit] = measured_in(name);
    const auto value = std::ranges::find(kValueColumns, quantity, &ValueColumn::quantity);
    if (unit > 0.0 && value != kValueColumns.end())
      read_value_column(position, *value, unit);
    else if (unit > 0.0 && quantity == "before")
      read_epoch_column(position, columns_.before, columns_.after, unit);
    else if (unit > 0.0 && quantity == "after")
      read_epoch_column(position, columns_.after, columns_.before, unit);
    else if (unit > 0.0 && quantity == "sigma")
      claim(columns_.sigma, position), columns_.sigma_factor = unit;
    else
      claim(other_column(name), position);
  }

  void read_value_column(std::size_t position, const ValueColumn& value, double unit) {
    claim(columns_.value, position);
    columns_.factor = value.sign * unit;
    columns_.change = value.change;
    columns_.vertical_only = value.vertical_only;
  }

  void read_epoch_column(std::size_t position, std::size_t& column, std::size_t other, double unit) {
    claim(column, position);
    if (other != kAbsent && epoch_unit_ != unit)
      fail(fmt::format("columns {} and {} have different units", in_quotes(names()[other]),
                       in_quotes(names()[position])));
    epoch_unit_ = unit;
  }

  std::size_t& other_column(const std::string& name) {
    if (name == "point") return columns_.point;
    if (name == "x_m") return columns_.x;
    if (name == "y_m") return columns_.y;
    if (name == "load") return columns_.load;
    if (name == "levelling") return columns_.levelling;
    fail(fmt::format("unknown column {}{}", in_quotes(name), advice_on(name)));
  }

  void check_point() const {
    const bool named = columns_.point != kAbsent;
    const bool placed = columns_.x != kAbsent && columns_.y != kAbsent;
    const bool half_placed = (columns_.x != kAbsent) != (columns_.y != kAbsent);
    if (half_placed || !(named || placed)) fail("nothing that names points");
  }

  void check_value() {
    const bool before = columns_.before != kAbsent, after = columns_.after != kAbsent;
    if (before != after)
      fail(before ? "values before without values after" : "values after without values before");
    if (before && columns_.value != kAbsent)
      fail(fmt::format("column {} beside values before and after", in_quotes(names()[columns_.value])));
    if (!before && columns_.value == kAbsent) fail("no value column");
    if (!before) return;
    columns_.factor = epoch_unit_;
    columns_.change = true;
  }

  const CsvTable& table_;
  ReadingsColumns columns_;
  double epoch_unit_ = 0.0;  // [m] of values before and after
};

}  // namespace

const std::string_view kReadingsColumns =
    "point, or x_m,y_m; one of uy_mm, settlement_mm, value_mm, change_mm, or before_mm,after_mm (_m: in "
    "metres); "
    "optionally sigma_mm, load, levelling, remark";

/// Beside a load a change is the load's own: what it adds. How that changed needs two epochs.
ReadingKind ReadingsColumns::kind() const {
  if (load != kAbsent) return two_epochs() ? ReadingKind::load_change : ReadingKind::load;
  return change ? ReadingKind::change : ReadingKind::absolute;
}

ReadingsColumns find_readings_columns(const CsvTable& table) {
  ReadingsColumns columns = Header(table).read();
  std::vector<std::size_t> numbers;
  for (const std::size_t column :
       {columns.x, columns.y, columns.value, columns.before, columns.after, columns.sigma})
    if (column != kAbsent) numbers.push_back(column);
  columns.mark = decimal_mark_of(table, numbers);
  return columns;
}

}  // namespace voussoir
