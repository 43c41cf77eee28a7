#include "lookup/readings/decimal_mark.h"

#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "core/error.h"

using namespace voussoir;

namespace {

/// A table with one column of numbers.
CsvTable table_of(const std::vector<std::string>& numbers, char separator) {
  CsvTable table{"m.csv", separator, {1, {"uy_mm"}}, {}};
  for (const std::string& number : numbers)
    table.rows.push_back({static_cast<long>(table.rows.size()) + 2, {number}});
  return table;
}

DecimalMark mark_of(const std::vector<std::string>& numbers, char separator = ';') {
  return decimal_mark_of(table_of(numbers, separator), std::vector<std::size_t>{0});
}

std::string error_of_numbers(const std::vector<std::string>& numbers, char separator = ';') {
  try {
    mark_of(numbers, separator);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

/// How a person writes a number of thousandths, with groups of thousands or without.
std::string written(long thousandths, int decimals, char decimal, bool grouped) {
  std::string whole = std::to_string(std::abs(thousandths) / 1000);
  if (grouped)
    for (std::size_t place = whole.size(); place > 3;)
      whole.insert(place -= 3, 1, decimal == '.' ? ',' : '.');
  const std::string fraction = fmt::format("{:03}", std::abs(thousandths) % 1000).substr(0, decimals);
  return (thousandths < 0 ? "-" : "") + whole + (decimals > 0 ? decimal + fraction : "");
}

}  // namespace

TEST_CASE("Numbers are read with either decimal mark, grouped or not, and nothing else is a number") {
  CHECK(parse_number("-1.25", DecimalMark::point) == -1.25);
  CHECK(parse_number("-1,25", DecimalMark::comma) == -1.25);
  CHECK(parse_number("+1.234,5", DecimalMark::comma) == 1234.5);
  CHECK(parse_number("1,234,567.5", DecimalMark::point) == 1234567.5);
  CHECK(parse_number("1,5e-3", DecimalMark::comma) == 1.5e-3);
  CHECK(parse_number(".5", DecimalMark::point) == 0.5);
  CHECK(parse_number("5.", DecimalMark::point) == 5.0);
  for (const char* const text :
       {"1,25", "12,34.5", "0,123.5", "1,234,56", ",234", "1,234e2", "1.2.3", "1,,234", "",    "-",
        ".",    "e5",      "1e",      "1e+",      "+-1",  "--1",     "0x1p3", "inf",    "nan", "1 234"}) {
    INFO(text);
    CHECK_FALSE(parse_number(text, DecimalMark::point).has_value());
  }
}

TEST_CASE(
    "A table's decimal mark is never read wrongly: right or refused, for all short tables (brute force)") {
  const std::vector<long> values = {0, 5000, 250, -1234, 1500, 12345, -1234000, 1234567, 1000000, 999999000};
  int right = 0, refused = 0;
  for (const char decimal : {'.', ','})
    for (const bool grouped : {false, true})
      for (const int decimals : {0, 1, 3})
        for (const long a : values)
          for (const long b : values) {
            const auto as_kept = [&](long v) {
              return decimals == 0 ? v / 1000 * 1000 : decimals == 1 ? v / 100 * 100 : v;
            };
            const std::vector<std::string> texts = {written(a, decimals, decimal, grouped),
                                                    written(b, decimals, decimal, grouped)};
            try {
              const DecimalMark mark = mark_of(texts);
              INFO(texts[0] << " " << texts[1]);
              CHECK(parse_number(texts[0], mark).value() == Approx(1e-3 * as_kept(a)).epsilon(1e-14));
              CHECK(parse_number(texts[1], mark).value() == Approx(1e-3 * as_kept(b)).epsilon(1e-14));
              ++right;
            } catch (const InputError&) {
              ++refused;
            }
          }
  CHECK(right > 700);
  CHECK(refused > 50);
}

TEST_CASE(
    "Where no number decides the file is refused with both meanings, but for commas that separate fields") {
  CHECK(error_of_numbers({"5", "-1.234"}) ==
        "m.csv:3: '-1.234' is -1.234 or -1234, and no number of the file decides, expected one that shows "
        "the decimal "
        "mark (such as '-1.2340' in the place of '-1.234')");
  CHECK(error_of_numbers({"12,345"}).find("m.csv:2: '12,345' is 12345 or 12.345") == 0);
  CHECK(error_of_numbers({"12,345"}, ',').find("m.csv:2: '12,345' is 12345 or 12.345") == 0);
  CHECK(mark_of({"12.345", "-1.234"}, ',') == DecimalMark::point);
  CHECK(mark_of({"12.345", "1.5"}) == DecimalMark::point);
  CHECK(mark_of({"12.345", "1,5"}) == DecimalMark::comma);
  CHECK(mark_of({"7", "soft", "1.5mm", ""}) == DecimalMark::point);
}

TEST_CASE("Two decimal marks in one file are refused with both lines") {
  CHECK(error_of_numbers({"1.5", "1,5"}) ==
        "m.csv:3: '1,5' has a decimal comma, expected a decimal point as in line 2");
  CHECK(error_of_numbers({"7", "1.234,5", "0.25"}) ==
        "m.csv:4: '0.25' has a decimal point, expected a decimal comma as in line 3");
}
