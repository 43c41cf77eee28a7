#pragma once
/// @file The few rules of a measurements file's CSV: lines, comments, fields. No quoting beyond a
/// pair of quotation marks round a whole field.

#include <string_view>
#include <vector>

namespace voussoir {

/// The fields of one line that is neither empty nor a comment. Views into the text it was cut from.
struct CsvLine {
  long number = 0;  ///< in the file, from 1
  std::vector<std::string_view> fields;
};

/// Cuts a text into lines (LF or CRLF, with or without UTF-8 byte order mark), drops what follows '#', drops
/// empty lines, and cuts the rest at commas; blanks and one pair of quotation marks round a field are
/// removed.
std::vector<CsvLine> cut_csv(std::string_view text);

}  // namespace voussoir
