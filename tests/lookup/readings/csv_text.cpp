#include "lookup/readings/csv_text.h"

#include <catch2/catch.hpp>

#include "core/error.h"
#include "lookup/readings/decimal_mark.h"

using namespace voussoir;

namespace {

using Rows = std::vector<std::vector<std::string>>;

/// How a program writes a table.
struct Dialect {
  char separator;
  char decimal;
  bool quote_all;
  bool mark;  // byte order mark
  const char* line_end;
  bool shouting;              // header names in capitals
  const char* around;         // blanks around fields
  std::string extra_columns;  // separators at the end of every line
};

std::vector<Dialect> all_dialects() {
  std::vector<Dialect> dialects;
  for (const char separator : {',', ';', '\t'})
    for (const char decimal : {'.', ','})
      for (const bool quote_all : {false, true})
        for (const bool mark : {false, true})
          for (const char* const line_end : {"\n", "\r\n"})
            for (const bool shouting : {false, true})
              for (const char* const around : {"", "  "})
                for (const int extra : {0, 2})
                  dialects.push_back({separator, decimal, quote_all, mark, line_end, shouting, around,
                                      std::string(static_cast<std::size_t>(extra), separator)});
  return dialects;
}

std::string written(std::string field, const Dialect& dialect) {
  const bool needed = field.find_first_of(std::string("\"#") + dialect.separator) != std::string::npos;
  if (dialect.quote_all || needed) {
    std::string doubled;
    for (const char c : field) doubled += c == '"' ? std::string("\"\"") : std::string(1, c);
    field = '"' + doubled + '"';
  }
  return dialect.around + field + dialect.around;
}

std::string written_line(std::vector<std::string> fields, const Dialect& dialect) {
  std::string line;
  for (std::size_t i = 0; i < fields.size(); ++i)
    line += (i > 0 ? std::string(1, dialect.separator) : "") + written(fields[i], dialect);
  return line + dialect.extra_columns + dialect.line_end;
}

/// The table in a dialect; `numbers` are the columns whose points are decimal.
std::string written_table(const std::vector<std::string>& header, const Rows& rows, std::size_t number_column,
                          const Dialect& dialect) {
  std::vector<std::string> names = header;
  if (dialect.shouting)
    for (std::string& name : names)
      for (char& c : name) c = static_cast<char>(std::toupper(c));
  std::string text = dialect.mark ? "\xEF\xBB\xBF" : "";
  text += written_line(names, dialect);
  for (std::vector<std::string> row : rows) {
    for (char& c : row[number_column])
      if (c == '.') c = dialect.decimal;
    text += written_line(row, dialect);
  }
  return text;
}

std::string error_of(const std::string& text) {
  try {
    read_csv(text, "m.csv", "a, b");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("A table reads the same in every dialect that a spreadsheet writes (brute force over dialects)") {
  const std::vector<std::string> header = {"point", "uy_mm", "note"};
  const Rows rows = {{"T1", "-0.25", "block 10,4"},
                     {"a;b", "12.5", "say \"yes\""},
                     {"T3", "-1.234", "# 7"},
                     {"", "3e-2", ""},
                     {"T5", "", "a\tb"}};
  int read = 0;
  for (const Dialect& dialect : all_dialects()) {
    const CsvTable table = read_csv(written_table(header, rows, 1, dialect), "m.csv", "");
    const std::vector<std::size_t> numbers = {1};
    const DecimalMark mark = decimal_mark_of(table, numbers);
    REQUIRE(table.header.fields == header);
    REQUIRE(table.rows.size() == rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      CHECK(table.rows[i].fields[0] == rows[i][0]);
      CHECK(table.rows[i].fields[2] == rows[i][2]);
      CHECK(parse_number(table.rows[i].fields[1], mark) == parse_number(rows[i][1], DecimalMark::point));
    }
    ++read;
  }
  CHECK(read == 384);
}

TEST_CASE("Comments end at the line's end, and begin outside quotation marks or with the line") {
  const CsvTable table = read_csv("# a, b\n\"# c, d\";;\nx;y # \" open\n\n1;\"2 # 3\"\n;\n", "m.csv", "");
  CHECK(table.header.number == 3);
  CHECK(table.header.fields == std::vector<std::string>{"x", "y"});
  REQUIRE(table.rows.size() == 1);
  CHECK(table.rows[0].number == 5);
  CHECK(table.rows[0].fields == std::vector<std::string>{"1", "2 # 3"});
}

TEST_CASE("What is no table is refused with the file, the line and what was expected") {
  CHECK(error_of("") == "m.csv: the file is empty, expected a header line (a, b)");
  CHECK(error_of("a;b,c\n") == "m.csv:1: the header has commas and semicolons, expected one separator");
  CHECK(error_of("a,b\n1,2\n1\n") == "m.csv:3: 1 values, expected 2 as in the header");
  CHECK(error_of("a,b\nT1,1,5\n") ==
        "m.csv:2: 3 values, expected 2 as in the header (a number with a decimal comma needs quotation "
        "marks, or a "
        "file with semicolons)");
  CHECK(error_of("a;b\n1;\"2\n3;4\n") ==
        "m.csv:2: the quotation mark before '2' is not closed, expected another in this line");
  CHECK(error_of("a;b\n\"1\"x;2\n") ==
        "m.csv:2: 'x' follows a closing quotation mark, expected the end of the field (a quotation mark in a "
        "field "
        "is written twice)");
  CHECK(error_of("a,b,,\n1,2,,3\n") ==
        "m.csv:2: 4 values, expected 2 as in the header (a number with a decimal "
        "comma needs quotation marks, or a file with semicolons)");
  CHECK(error_of(std::string("a,b\n1\0,2\n", 9)) == "m.csv:1: the file holds binary data, expected CSV");
  for (const char* const mark : {"\xFF\xFEp", "\xFE\xFFp"})
    CHECK(error_of(mark) == "m.csv:1: the file is UTF-16, expected UTF-8 (save it as plain CSV)");
}

TEST_CASE(
    "A spreadsheet's failed formula is no comment, wherever it stands: an empty value would be silence") {
  for (const char* const failure :
       {"#N/A", "#NV", "#DIV/0!", "#WERT!", "#VALUE!", "#REF!", "#BEZUG!", "#NAME?"})
    for (const std::string& text :
         {std::string("a,b\nT1,1\nT12,"), std::string("a;b\nT1;1\nT12; "), std::string("a\tb\nT1\t1\nT12\t"),
          std::string("a,b\nT1,1\nT12,\""), std::string("a,b,c\nT1,1,1\nT12,")}) {
      const std::string end = text.ends_with('"') ? "\"\n" : text.starts_with("a,b,c") ? ",1\n" : "\n";
      INFO(text << failure << end);
      CHECK(error_of(text + failure + end) ==
            "m.csv:3: '" + std::string(failure) +
                "' is what a spreadsheet writes where it has no value, expected a number, or nothing for a "
                "sensor that gave no reading");
    }
  CHECK_THAT(error_of("a,b\n#N/A,1\n"), Catch::Contains("m.csv:2: '#N/A' is what a spreadsheet writes"));
  const CsvTable unknown = read_csv("a,b\nT12,#FEHLT\n", "m.csv", "");  // refused where a number is expected
  CHECK(unknown.rows[0].fields[1] == "#FEHLT");
}

TEST_CASE(
    "Comments stay comments behind values, behind blanks and behind a separator with a blank (written out)") {
  for (const char* const line :
       {"T1,1 # why", "T1,1# why", "T1,1 #why", "T1,1,# why", "T1,1, #why", "T1,1,#"}) {
    INFO(line);
    const CsvTable table = read_csv("a,b\n" + std::string(line) + "\n#NVE wrote this\n#5\n", "m.csv", "");
    REQUIRE(table.rows.size() == 1);
    CHECK(table.rows[0].fields == std::vector<std::string>{"T1", "1"});
  }
}

TEST_CASE("Excel's first line says what separates the fields") {
  for (const std::string& first : {std::string("sep=;\n"), std::string("\xEF\xBB\xBFSEP=;\r\n")}) {
    const CsvTable table = read_csv(first + "a;b\n1,5;2\n", "m.csv", "");
    CHECK(table.separator == ';');
    CHECK(table.rows[0].number == 3);
    CHECK(table.rows[0].fields == std::vector<std::string>{"1,5", "2"});
  }
  CHECK(read_csv("sep=\t\na\tb\n1\t2\n", "m.csv", "").rows[0].fields[1] == "2");
  CHECK(error_of("sep=|\na|b\n") == "m.csv:1: '|' separates fields, expected a comma, a semicolon or a tab");
}

TEST_CASE("Lines that end with CR alone, as on old Macs, are lines") {
  const CsvTable table = read_csv("a,b\r1,2\r\r3,4", "m.csv", "");
  REQUIRE(table.rows.size() == 2);
  CHECK(table.rows[1].number == 4);
  CHECK(table.rows[1].fields == std::vector<std::string>{"3", "4"});
}

TEST_CASE("Blanks in a column's name are those between its words") {
  CHECK(read_csv("Point;Change mm\n", "m.csv", "").header.fields ==
        std::vector<std::string>{"point", "change_mm"});
}
