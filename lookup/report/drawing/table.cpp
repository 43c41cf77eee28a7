#include "lookup/report/drawing/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/json_text.h"
#include "core/text.h"
#include "lookup/readings/csv_text.h"

namespace voussoir {
namespace {

std::string csv_cell(const TableCell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return csv_field(*text);
  const double number = std::get<double>(cell);
  return std::isnan(number) ? "" : fmt::format("{}", number);
}

/// The typographic minus sign is as wide as a digit.
std::string with_minus_sign(std::string number) {
  for (std::size_t at = number.find('-'); at != std::string::npos; at = number.find('-', at))
    number.replace(at, 1, "\u2212");
  return number;
}

/// With so many decimals, zero without a sign; or with significant digits.
std::string number_text(double number, int decimals, int digits) {
  if (std::isnan(number)) return "";
  if (decimals == kAsNeeded) return with_minus_sign(fmt::format("{:.{}g}", number, digits));
  return with_minus_sign(fixed_decimals(number, decimals));
}

std::string html_cell(const TableCell& cell, int decimals, int digits) {
  if (const auto* text = std::get_if<std::string>(&cell)) return "<td>" + escaped(*text) + "</td>";
  return fmt::format("<td class=\"number\">{}</td>", number_text(std::get<double>(cell), decimals, digits));
}

bool holds_numbers(const Table& table, std::size_t column) {
  return std::any_of(table.rows.begin(), table.rows.end(), [&](const std::vector<TableCell>& row) {
    return std::holds_alternative<double>(row[column]);
  });
}

}  // namespace

std::string fixed_decimals(double number, int decimals) {
  const std::string text = fmt::format("{:.{}f}", number, decimals);
  const bool is_zero = text.find_first_not_of("-0.") == std::string::npos;
  return is_zero && text.front() == '-' ? text.substr(1) : text;
}

std::string to_csv(const Table& table) {
  std::string text;
  for (std::size_t i = 0; i < table.columns.size(); ++i)
    text += (i == 0 ? "" : ",") + csv_field(table.columns[i]);
  text += '\n';
  for (const std::vector<TableCell>& row : table.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) text += (i == 0 ? "" : ",") + csv_cell(row[i]);
    text += '\n';
  }
  return text;
}

std::string to_json(const Table& table) {
  auto list = nlohmann::ordered_json::array();
  for (const std::vector<TableCell>& row : table.rows) {
    nlohmann::ordered_json& object = list.emplace_back(nlohmann::ordered_json::object());
    for (std::size_t i = 0; i < row.size(); ++i) {
      const auto* number = std::get_if<double>(&row[i]);
      if (number == nullptr)
        object[table.columns[i]] = std::get<std::string>(row[i]);
      else
        object[table.columns[i]] =
            std::isnan(*number) ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(*number);
    }
  }
  return json_text(list, 1);
}

std::string to_html(const Table& table, int digits) {
  std::string html = "<table><thead><tr>";
  for (std::size_t i = 0; i < table.columns.size(); ++i)
    html += fmt::format("<th{}>{}</th>", holds_numbers(table, i) ? " class=\"number\"" : "",
                        escaped(table.columns[i]));
  html += "</tr></thead><tbody>\n";
  for (const std::vector<TableCell>& row : table.rows) {
    html += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i)
      html += html_cell(row[i], i < table.decimals.size() ? table.decimals[i] : kAsNeeded, digits);
    html += "</tr>\n";
  }
  return html + "</tbody></table>\n";
}

}  // namespace voussoir
