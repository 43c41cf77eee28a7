#pragma once
/// @file Tables as spreadsheets write them: CSV with any of the usual separators.

#include <string>
#include <string_view>
#include <vector>

namespace voussoir {

/// The fields of one line, without quotation marks and without blanks around them.
struct CsvLine {
  long number = 0;  ///< in the file, from 1
  std::vector<std::string> fields;
};

/// A header and rows with as many fields as the header has names.
struct CsvTable {
  std::string file;  ///< its name, for messages
  char separator = ',';
  CsvLine header;  ///< names in lower case
  std::vector<CsvLine> rows;

  /// Throws InputError "file:line: message"; line 0: of the whole file.
  [[noreturn]] void fail(long line, const std::string& message) const;
};

/// Reads a table. UTF-8 with or without byte order mark; LF, CRLF or CR; '#' outside quotation marks starts a
/// comment, but not directly behind a separator unless a blank follows; lines without text are left out. The
/// separator is the one that a first line "sep=;" states or that the header has: comma, semicolon or, without
/// these, tab. Blanks in the header's names count as '_'. A field may stand in quotation marks, and a
/// quotation mark in it is written twice. Columns at the end without name and values are left out, as
/// spreadsheets add them. Throws InputError for other encodings, for a header with commas and semicolons, for
/// quotation marks that are not closed, for rows of another length and for what spreadsheets write where a
/// formula failed (#N/A). `columns` says which header was expected.
CsvTable read_csv(std::string_view text, const std::string& file, std::string_view columns);

/// A text as a field of a table with commas that read_csv reads: in quotation marks where it needs them.
std::string csv_field(const std::string& text);

}  // namespace voussoir
