#pragma once
/// @file The few rules by which files and command lines are cut into words and numbers.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace voussoir {

/// Without blanks, tabs and line ends before and behind.
std::string_view trimmed(std::string_view text);

/// The parts between separators, trimmed; one more than there are separators.
std::vector<std::string_view> split(std::string_view text, char separator);

/// The whole number, zero or more, that fills the text; nothing if it does not.
std::optional<int> parse_whole_number(std::string_view text);

/// The finite number that fills the text, whatever the locale; nothing if it does not, for NaN, for
/// infinities and for a number too large for a double. A number too small for a double is zero.
std::optional<double> parse_number(std::string_view text);

/// The text between apostrophes, shortened and without unprintable bytes, fit for an error message. What is
/// neither ASCII nor a Latin letter is named by its number: <U+2212>, or <0xE9> for a byte that is no UTF-8.
std::string in_quotes(std::string_view text);

/// Names that are numbered on are named by the first and the last: "T1 to T20, N1, N2". Of many such parts
/// the last are left out.
std::string names_in_words(const std::vector<std::string>& names);

template <class Things>
std::vector<std::string> names_of(const Things& things) {
  std::vector<std::string> names;
  for (const auto& thing : things) names.push_back(thing.name);
  return names;
}

/// The text with &, <, > and quotation marks as character references.
std::string escaped(std::string_view text);

}  // namespace voussoir
