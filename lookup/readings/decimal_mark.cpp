#include "lookup/readings/decimal_mark.h"

#include <algorithm>

#include "core/error.h"
#include "core/text.h"

namespace voussoir {
namespace {

constexpr std::size_t kGroup = 3;              // digits between marks of thousands
constexpr std::string_view kMinus = "\u2212";  // as word processors and some locales write it

char sign_of(DecimalMark mark) {
  return mark == DecimalMark::point ? '.' : ',';
}

DecimalMark other(DecimalMark mark) {
  return mark == DecimalMark::point ? DecimalMark::comma : DecimalMark::point;
}

std::string_view name_of(DecimalMark mark) {
  return mark == DecimalMark::point ? "point" : "comma";
}

bool all_digits(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// Digits, grouped in threes if they have any group mark.
std::optional<std::string> ungrouped(std::string_view whole, char group_mark) {
  if (whole.find(group_mark) == std::string_view::npos)
    return all_digits(whole) ? std::optional(std::string(whole)) : std::nullopt;
  if (whole.starts_with('0')) return std::nullopt;
  std::string digits;
  for (std::size_t start = 0; start <= whole.size();) {
    const std::size_t end = std::min(whole.find(group_mark, start), whole.size());
    const std::string_view group = whole.substr(start, end - start);
    const bool fits = start == 0 ? !group.empty() && group.size() <= kGroup : group.size() == kGroup;
    if (!fits || !all_digits(group)) return std::nullopt;
    digits += group;
    start = end + 1;
  }
  return digits;
}

bool is_exponent(std::string_view text) {
  if (text.starts_with('+') || text.starts_with('-')) text.remove_prefix(1);
  return !text.empty() && all_digits(text);
}

/// The number with a decimal point and without groups; nothing if the text is no number with this mark.
std::optional<std::string> plain(std::string_view text, DecimalMark mark) {
  const bool typeset = text.starts_with(kMinus);
  const bool negative = typeset || text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(typeset ? kMinus.size() : 1);
  const std::size_t e = std::min(text.find_first_of("eE"), text.size());
  const std::string_view mantissa = text.substr(0, e);
  const std::string_view exponent = text.substr(std::min(e + 1, text.size()));
  const std::size_t place = std::min(mantissa.find(sign_of(mark)), mantissa.size());
  const std::string_view fraction = mantissa.substr(std::min(place + 1, mantissa.size()));
  const auto whole = ungrouped(mantissa.substr(0, place), sign_of(other(mark)));
  const bool has_exponent = e < text.size();
  const bool grouped = whole && whole->size() < place;
  if (!whole || !all_digits(fraction) || (whole->empty() && fraction.empty())) return std::nullopt;
  if (has_exponent && (grouped || !is_exponent(exponent))) return std::nullopt;
  return (negative ? "-" : "") + *whole + (fraction.empty() ? "" : "." + std::string(fraction)) +
         (has_exponent ? "e" + std::string(exponent) : "");
}

/// Collects what the numbers of a table say.
class Numbers {
 public:
  explicit Numbers(const CsvTable& table) : table_(table) {}

  void look_at(const std::string& field, long line) {
    if (field.find_first_of(".,") == std::string::npos) return;
    const bool point = plain(field, DecimalMark::point).has_value();
    const bool comma = plain(field, DecimalMark::comma).has_value();
    if (!point && !comma) return;
    has_comma_ = has_comma_ || field.find(',') != std::string::npos;
    if (point != comma)
      decide(point ? DecimalMark::point : DecimalMark::comma, field, line);
    else if (!undecided_)
      undecided_ = {field, line};
  }

  DecimalMark mark() const {
    if (decided_) return decided_->mark;
    const bool commas_separate = table_.separator == ',' && !has_comma_;
    if (undecided_ && !commas_separate)
      table_.fail(
          undecided_->line,
          fmt::format("{0} is {1} or {2}, and no number of the file decides, expected one that shows "
                      "the decimal mark (such as '{3}0' in the place of {0})",
                      in_quotes(undecided_->field), *parse_number(undecided_->field, DecimalMark::point),
                      *parse_number(undecided_->field, DecimalMark::comma), undecided_->field));
    return DecimalMark::point;
  }

 private:
  struct Decided {
    DecimalMark mark;
    long line;
  };
  struct Undecided {
    std::string field;
    long line;
  };

  void decide(DecimalMark mark, const std::string& field, long line) {
    if (!decided_) decided_ = {mark, line};
    if (decided_->mark != mark)
      table_.fail(line,
                  fmt::format("{} has a decimal {}, expected a decimal {} as in line {}", in_quotes(field),
                              name_of(mark), name_of(decided_->mark), decided_->line));
  }

  const CsvTable& table_;
  std::optional<Decided> decided_;      // by the first number that fits one mark only
  std::optional<Undecided> undecided_;  // the first number that fits both
  bool has_comma_ = false;              // in some number
};

}  // namespace

std::optional<double> parse_number(std::string_view text, DecimalMark mark) {
  const auto number = plain(text, mark);
  return number ? parse_number(*number) : std::nullopt;
}

DecimalMark decimal_mark_of(const CsvTable& table, std::span<const std::size_t> columns) {
  Numbers numbers(table);
  for (const CsvLine& row : table.rows)
    for (const std::size_t column : columns) numbers.look_at(row.fields[column], row.number);
  return numbers.mark();
}

}  // namespace voussoir
