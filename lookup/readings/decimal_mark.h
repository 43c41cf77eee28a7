#pragma once
/// @file Numbers with a decimal point or a decimal comma, and which of them a table has.
///
/// A number is digits, at most one decimal mark, and an exponent; what stands before the decimal mark may be
/// grouped in threes by the other mark ("1.234,5" has a decimal comma), if it has no exponent and does not
/// start with zero. Many numbers fit one mark only: "0.25", "1.5", "1234.567" and "1,234.5" have a point. The
/// table has the mark that all its numbers fit. Where all fit both ("1.234" is 1.234 or 1234), nothing is
/// guessed, with one exception: commas that separate fields and occur in no number leave the point.

#include <optional>
#include <span>
#include <string_view>

#include "lookup/readings/csv_text.h"

namespace voussoir {

enum class DecimalMark { point, comma };

/// The finite number that fills the text, as core's parse_number otherwise.
std::optional<double> parse_number(std::string_view text, DecimalMark mark);

/// The mark of the numbers in these columns; point if no number has any. Fields that are no numbers do not
/// count. Throws InputError where two numbers have different marks and where none decides.
DecimalMark decimal_mark_of(const CsvTable& table, std::span<const std::size_t> columns);

}  // namespace voussoir
