#include "lookup/readings/csv_text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>

#include "core/error.h"
#include "core/text.h"

namespace voussoir {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr char kQuote = '"';
constexpr char kComment = '#';
constexpr std::string_view kBetweenWords = " _[]()";  // of a column's name

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}

bool all_empty(const std::vector<std::string>& fields, std::size_t from = 0) {
  return std::all_of(fields.begin() + static_cast<std::ptrdiff_t>(from), fields.end(),
                     [](const std::string& field) { return field.empty(); });
}

/// What spreadsheets write where a formula failed, in some of their languages.
constexpr std::array<std::string_view, 17> kFailures = {
    "#N/A",   "#NV",    "#DIV/0!",  "#WERT!",  "#VALUE!",  "#REF!", "#BEZUG!",  "#NAME?", "#NUM!",
    "#ZAHL!", "#NULL!", "#VALEUR!", "#VALOR!", "#VALORE!", "#NOM?", "#NOMBRE!", "#SPILL!"};

/// The failure with which the text begins, or nothing.
std::string_view failure_at(std::string_view text, char separator) {
  for (const std::string_view failure : kFailures) {
    if (!text.starts_with(failure)) continue;
    const std::string_view rest = text.substr(failure.size());
    if (rest.empty() || rest.front() == separator || rest.front() == kQuote || is_blank(rest.front()))
      return failure;
  }
  return {};
}

/// A line whose first sign, be it within quotation marks, starts a comment.
bool is_comment(std::string_view line, char separator) {
  line = trimmed(line);
  if (line.starts_with(kQuote)) line = trimmed(line.substr(1));
  return line.starts_with(kComment) && failure_at(line, separator).empty();
}

class Cutter {
 public:
  Cutter(const CsvTable& table, long number, std::string_view line)
      : table_(table), number_(number), line_(line) {}

  std::vector<std::string> fields() {
    std::vector<std::string> result;
    do {
      result.push_back(next_starts_with_quote() ? quoted_field() : plain_field());
    } while (at_separator());
    return result;
  }

 private:
  /// Steps over a separator; false at the end of the line and at a comment.
  bool at_separator() {
    if (place_ >= line_.size() || line_[place_] != table_.separator) return false;
    ++place_;
    return true;
  }

  bool next_starts_with_quote() {
    std::size_t place = place_;
    while (place < line_.size() && line_[place] != table_.separator && is_blank(line_[place])) ++place;
    if (place >= line_.size() || line_[place] != kQuote) return false;
    place_ = place + 1;
    return true;
  }

  bool at_end() const {
    return place_ >= line_.size() || line_[place_] == table_.separator || line_[place_] == kComment;
  }

  /// What stands directly behind a separator is no comment unless a blank follows its sign, and a
  /// spreadsheet's failure is none anywhere: an empty value would be a sensor that fell silent.
  bool begins_with_comment_sign() const {
    const std::string_view rest = trimmed(line_.substr(place_));
    if (!rest.starts_with(kComment)) return false;
    if (!failure_at(rest, table_.separator).empty()) return true;
    return place_ > 0 && line_[place_] == kComment && rest.size() > 1 && !is_blank(rest[1]);
  }

  std::string plain_field() {
    const std::size_t start = place_;
    if (begins_with_comment_sign()) place_ = line_.find(kComment, place_) + 1;
    while (!at_end()) ++place_;
    return std::string(trimmed(line_.substr(start, place_ - start)));
  }

  std::string quoted_field() {
    std::string text;
    for (; place_ < line_.size(); ++place_) {
      const bool twice = line_.substr(place_).starts_with("\"\"");
      if (line_[place_] == kQuote && !twice) break;
      if (twice) ++place_;
      text += line_[place_];
    }
    if (place_ == line_.size())
      table_.fail(number_,
                  fmt::format("the quotation mark before {} is not closed, expected another in this line",
                              in_quotes(text)));
    ++place_;
    const std::string rest = plain_field();
    if (!rest.empty())
      table_.fail(number_, fmt::format("{} follows a closing quotation mark, expected the end of the field "
                                       "(a quotation mark in a field is written twice)",
                                       in_quotes(rest)));
    return std::string(trimmed(text));
  }

  const CsvTable& table_;
  long number_;
  std::string_view line_;
  std::size_t place_ = 0;
};

void check_encoding(std::string_view text, const CsvTable& table) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
    table.fail(1, "the file is UTF-16, expected UTF-8 (save it as plain CSV)");
  if (text.find('\0') != std::string_view::npos) table.fail(1, "the file holds binary data, expected CSV");
}

/// Whether the text has the sign outside quotation marks and comments.
bool has_outside_quotes(std::string_view line, char sign) {
  bool inside = false;
  for (const char c : line) {
    if (c == kQuote) inside = !inside;
    if (!inside && c == kComment) return false;
    if (!inside && c == sign) return true;
  }
  return false;
}

char separator_of(std::string_view header, long number, const CsvTable& table) {
  const bool comma = has_outside_quotes(header, ',');
  const bool semicolon = has_outside_quotes(header, ';');
  if (comma && semicolon) table.fail(number, "the header has commas and semicolons, expected one separator");
  if (comma || semicolon) return comma ? ',' : ';';
  return has_outside_quotes(header, '\t') ? '\t' : ',';
}

/// Excel's first line "sep=;", which says what separates the fields of the following ones.
std::optional<char> stated_separator(std::string_view line, long number, const CsvTable& table) {
  constexpr std::string_view kStatement = "sep=";
  if (line.ends_with('\r')) line.remove_suffix(1);
  if (number != 1 || lower_case(std::string(line.substr(0, kStatement.size()))) != kStatement)
    return std::nullopt;
  const std::string_view sign = line.substr(kStatement.size());
  if (sign != "," && sign != ";" && sign != "\t")
    table.fail(number,
               fmt::format("{} separates fields, expected a comma, a semicolon or a tab", in_quotes(sign)));
  return sign.front();
}

/// "Change [mm]" is change_mm.
CsvLine header_of(std::string_view line, long number, std::string_view columns, const CsvTable& table) {
  CsvLine header{number, Cutter(table, number, line).fields()};
  for (std::string& name : header.fields) {
    std::string words;
    for (const char c : lower_case(std::move(name)))
      if (kBetweenWords.find(c) == std::string_view::npos)
        words += c;
      else if (!words.empty() && words.back() != '_')
        words += '_';
    if (words.ends_with('_')) words.pop_back();
    name = std::move(words);
  }
  while (header.fields.size() > 1 && header.fields.back().empty()) header.fields.pop_back();
  if (header.fields.size() == 1)
    table.fail(
        number,
        fmt::format(
            "{} is no header, expected several columns with commas, semicolons or tabs between them ({})",
            in_quotes(trimmed(line)), columns));
  return header;
}

void add_row(std::string_view line, long number, CsvTable& table) {
  CsvLine row{number, Cutter(table, number, line).fields()};
  if (all_empty(row.fields)) return;
  for (const std::string& field : row.fields)
    if (!failure_at(field, table.separator).empty())
      table.fail(number, fmt::format("{} is what a spreadsheet writes where it has no value, expected a "
                                     "number, or nothing for a sensor that gave no reading",
                                     in_quotes(field)));
  const std::size_t expected = table.header.fields.size();
  if (row.fields.size() > expected && all_empty(row.fields, expected)) row.fields.resize(expected);
  if (row.fields.size() != expected)
    table.fail(
        number,
        fmt::format("{} values, expected {} as in the header{}", row.fields.size(), expected,
                    row.fields.size() > expected && table.separator == ','
                        ? " (a number with a decimal comma needs quotation marks, or a file with semicolons)"
                        : ""));
  table.rows.push_back(std::move(row));
}

}  // namespace

void CsvTable::fail(long line, const std::string& message) const {
  throw InputError(at_line(file, line, message));
}

CsvTable read_csv(std::string_view text, const std::string& file, std::string_view columns) {
  CsvTable table{file, ',', {}, {}};
  check_encoding(text, table);
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  // Only programs of old Macs end lines with CR alone.
  const char line_end = text.find('\n') == std::string_view::npos ? '\r' : '\n';
  std::optional<char> stated;
  long number = 0;
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find(line_end, start), text.size());
    const std::string_view line = text.substr(start, end - start);
    start = end + 1;
    ++number;
    if (trimmed(line).empty() || is_comment(line, table.separator)) continue;
    if (!table.header.fields.empty()) {
      add_row(line, number, table);
    } else if (const auto separator = stated_separator(line, number, table)) {
      stated = separator;
    } else {
      table.separator = stated ? *stated : separator_of(line, number, table);
      table.header = header_of(line, number, columns, table);
    }
  }
  if (table.header.fields.empty())
    table.fail(0, fmt::format("the file is empty, expected a header line ({})", columns));
  return table;
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"#\r\n") == std::string::npos) return text;
  std::string doubled;
  for (const char c : text) doubled += c == '"' ? std::string("\"\"") : std::string(1, c);
  return '"' + doubled + '"';
}

}  // namespace voussoir
