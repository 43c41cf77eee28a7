#include "lookup/readings/csv_text.h"

#include "core/text.h"

namespace voussoir {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

std::string_view unquoted(std::string_view text) {
  const bool has_quotes = text.size() >= 2 && text.front() == '"' && text.back() == '"';
  return has_quotes ? trimmed(text.substr(1, text.size() - 2)) : text;
}

std::vector<std::string_view> cut_fields(std::string_view line) {
  std::vector<std::string_view> fields = split(line, ',');
  for (std::string_view& field : fields) field = unquoted(field);
  return fields;
}

}  // namespace

std::vector<CsvLine> cut_csv(std::string_view text) {
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  std::vector<CsvLine> lines;
  long number = 0;
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    const std::string_view whole = text.substr(start, end - start);
    const std::string_view line = trimmed(whole.substr(0, whole.find('#')));
    ++number;
    if (!line.empty()) lines.push_back({number, cut_fields(line)});
    start = end + 1;
  }
  return lines;
}

}  // namespace voussoir
