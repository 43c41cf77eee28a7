#include "core/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>

namespace voussoir {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";
constexpr std::size_t kLongestQuote = 40;  // longer texts are cut in messages

/// True if a positive number that a double cannot hold is too large for it, false if it is too small: which
/// of them, the decimal place of its first digit says.
bool is_too_large(std::string_view text) {
  const std::size_t end = std::min(text.find_first_of("eE"), text.size());
  const std::string_view digits = text.substr(0, end);
  const auto first = static_cast<long>(digits.find_first_of("123456789"));
  const auto point = static_cast<long>(std::min(digits.find('.'), digits.size()));
  std::string_view exponent = text.substr(std::min(end + 1, text.size()));
  if (exponent.starts_with('+')) exponent.remove_prefix(1);
  long shift = 0;
  const auto read = std::from_chars(exponent.data(), exponent.data() + exponent.size(), shift);
  if (read.ec == std::errc::result_out_of_range) return !exponent.starts_with('-');
  return point - first + shift > 0;
}

/// Of the sign of UTF-8 with which the text begins; 1 for a byte that begins none.
std::size_t bytes_of_sign(std::string_view text) {
  const auto first = static_cast<unsigned char>(text.front());
  const std::size_t bytes = first >= 0xC2 && first <= 0xDF   ? 2
                            : first >= 0xE0 && first <= 0xEF ? 3
                            : first >= 0xF0 && first <= 0xF4 ? 4
                                                             : 1;
  if (bytes > text.size()) return 1;
  const bool whole = std::ranges::all_of(
      text.substr(1, bytes - 1), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80; });
  return whole ? bytes : 1;
}

/// Letters of Latin alphabets as they are. Other signs may be invisible, or mean something to a terminal:
/// their number in Unicode, or the byte's.
std::string readable(std::string_view sign) {
  const auto first = static_cast<unsigned char>(sign.front());
  if (sign.size() == 1 && first < 0x80) return first < 0x20 || first == 0x7F ? "?" : std::string(sign);
  if (sign.size() == 1) return fmt::format("<0x{:02X}>", first);
  std::uint32_t number = first & (0xFFU >> (sign.size() + 1));
  for (const char c : sign.substr(1)) number = number << 6U | (static_cast<unsigned char>(c) & 0x3FU);
  const bool letter = number >= 0xC0 && number <= 0x24F && number != 0xD7 && number != 0xF7;
  return letter ? std::string(sign) : fmt::format("<U+{:04X}>", number);
}

constexpr std::size_t kMostParts = 8;  // of names in words

/// What is numbered on from a name: T10 after T9. Nothing without a number.
std::string next_name(const std::string& name) {
  const std::size_t digits = name.find_last_not_of("0123456789") + 1;
  const auto number = parse_whole_number(std::string_view(name).substr(digits));
  return number ? fmt::format("{}{}", name.substr(0, digits), *number + 1) : "";
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(separator, start), text.size());
    parts.push_back(trimmed(text.substr(start, end - start)));
    start = end + 1;
  }
  return parts;
}

std::optional<int> parse_whole_number(std::string_view text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || number < 0) return std::nullopt;
  return number;
}

std::optional<double> parse_number(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double number = 0.0;
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, number);
  if (end != last || error == std::errc::invalid_argument) return std::nullopt;
  if (error == std::errc::result_out_of_range) return is_too_large(text) ? std::nullopt : std::optional(0.0);
  return std::isfinite(number) ? std::optional(number) : std::nullopt;
}

std::string in_quotes(std::string_view text) {
  std::string result = "'";
  std::size_t signs = 0, place = 0;
  for (; place < text.size() && signs < kLongestQuote; ++signs) {
    const std::size_t bytes = bytes_of_sign(text.substr(place));
    result += readable(text.substr(place, bytes));
    place += bytes;
  }
  return result + (place < text.size() ? "...'" : "'");
}

std::string names_in_words(const std::vector<std::string>& names) {
  std::string text;
  std::size_t parts = 0;
  for (std::size_t first = 0; first < names.size(); ++parts) {
    std::size_t last = first;
    while (last + 1 < names.size() && names[last + 1] == next_name(names[last])) ++last;
    if (last == first + 1) last = first;  // two are named themselves
    if (parts == kMostParts) return text + ", ...";
    text += fmt::format("{}{}", parts > 0 ? ", " : "", names[first]);
    if (last > first) text += " to " + names[last];
    first = last + 1;
  }
  return text;
}

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  return result;
}

}  // namespace voussoir
