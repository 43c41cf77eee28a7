#include "lookup/readings/readings_columns.h"

#include <algorithm>
#include <array>

#include "core/error.h"
#include "core/text.h"
#include "core/units.h"

namespace voussoir {
namespace {

struct ValueColumn {
  std::string_view name;
  double factor;
  bool change;
  bool vertical_only;
};
constexpr std::array<ValueColumn, 5> kValueColumns = {{{"uy_mm", kMetresPerMillimetre, false, true},
                                                       {"uy_m", 1.0, false, true},
                                                       {"settlement_mm", -kMetresPerMillimetre, false, true},
                                                       {"value_mm", kMetresPerMillimetre, false, false},
                                                       {"change_mm", kMetresPerMillimetre, true, false}}};

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
    const auto value = std::find_if(kValueColumns.begin(), kValueColumns.end(),
                                    [&](const ValueColumn& column) { return column.name == name; });
    if (value == kValueColumns.end()) {
      claim(other_column(name), position);
      return;
    }
    claim(columns_.value, position);
    columns_.factor = value->factor;
    columns_.change = value->change;
    columns_.vertical_only = value->vertical_only;
  }

  std::size_t& other_column(const std::string& name) {
    if (name == "point") return columns_.point;
    if (name == "x_m") return columns_.x;
    if (name == "y_m") return columns_.y;
    if (name == "before_mm") return columns_.before;
    if (name == "after_mm") return columns_.after;
    if (name == "sigma_mm") return columns_.sigma;
    if (name == "load") return columns_.load;
    if (name == "levelling") return columns_.levelling;
    fail(fmt::format("unknown column {}", in_quotes(name)));
  }

  void check_point() const {
    const bool named = columns_.point != kAbsent;
    const bool placed = columns_.x != kAbsent && columns_.y != kAbsent;
    const bool half_placed = (columns_.x != kAbsent) != (columns_.y != kAbsent);
    if (named == placed || half_placed) fail("no single way to name a point");
  }

  void check_value() {
    const bool before = columns_.before != kAbsent, after = columns_.after != kAbsent;
    if (before != after)
      fail(before ? "column 'before_mm' without 'after_mm'" : "column 'after_mm' without 'before_mm'");
    if (before && columns_.value != kAbsent)
      fail(fmt::format("column {} beside 'before_mm' and 'after_mm'", in_quotes(names()[columns_.value])));
    if (!before && columns_.value == kAbsent) fail("no value column");
    if (!before) return;
    columns_.factor = kMetresPerMillimetre;
    columns_.change = true;
  }

  const CsvTable& table_;
  ReadingsColumns columns_;
};

}  // namespace

const std::string_view kReadingsColumns =
    "point or x_m,y_m; one of uy_mm, uy_m, settlement_mm, value_mm, change_mm, or before_mm,after_mm; "
    "optionally sigma_mm, load, levelling";

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
