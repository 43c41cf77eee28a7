#pragma once
/// @file Which column of a table of readings holds what.

#include <limits>
#include <string_view>

#include "lookup/readings/csv_text.h"
#include "lookup/readings/decimal_mark.h"
#include "lookup/readings/reading_kind.h"

namespace voussoir {

inline constexpr std::size_t kAbsent = std::numeric_limits<std::size_t>::max();

struct ReadingsColumns {
  std::size_t point = kAbsent;
  std::size_t x = kAbsent;
  std::size_t y = kAbsent;
  std::size_t value = kAbsent;
  std::size_t before = kAbsent;
  std::size_t after = kAbsent;
  std::size_t sigma = kAbsent;
  std::size_t load = kAbsent;
  std::size_t levelling = kAbsent;
  double factor = 1.0;         ///< from the value's unit and sign to metres, up positive
  double sigma_factor = 1.0;   ///< the same of sigma
  bool change = false;         ///< the value is one
  bool vertical_only = false;  ///< the value's name says what is read
  DecimalMark mark = DecimalMark::point;

  bool two_epochs() const { return before != kAbsent; }
  ReadingKind kind() const;
};

/// What a header may have, for messages.
extern const std::string_view kReadingsColumns;

/// Throws InputError for a header that leaves open what is read where, and for numbers with two decimal
/// marks.
ReadingsColumns find_readings_columns(const CsvTable& table);

}  // namespace voussoir
