#pragma once
/// @file A table: the numbers behind a picture.

#include <string>
#include <variant>
#include <vector>

namespace voussoir {

/// A text or a number; NaN is an empty cell.
using TableCell = std::variant<std::string, double>;

inline constexpr int kAsNeeded = -1;

struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<TableCell>> rows;  ///< each as long as `columns`
  std::vector<int> decimals = {};            ///< of the numbers on a page, by column; kAsNeeded, and what is
                                             ///< left out: some significant digits
};

/// "0.010", "-1.500"; what is rounded to zero has no sign.
std::string fixed_decimals(double number, int decimals);

/// Comma-separated, numbers with all their digits, texts quoted where they need to be.
std::string to_csv(const Table& table);

/// A list of objects, one a row, with the columns' names; NaN is null.
std::string to_json(const Table& table);

/// <table>, numbers with the decimals of their column, else with `digits` significant digits.
std::string to_html(const Table& table, int digits = 4);

}  // namespace voussoir
