#include "lookup/report/drawing/page.h"

#include <fmt/format.h>

#include "core/text.h"
#include "lookup/report/drawing/style.h"

namespace voussoir {
namespace {

/// Nothing may be fetched, whatever stands in the page.
constexpr const char* kPolicy =
    "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:";

std::string table_html(const Figure& figure) {
  if (figure.table.columns.empty()) return "";
  const std::string table = "<div class=\"scroll\">" + to_html(figure.table, figure.digits) + "</div>";
  if (figure.view == TableView::open) return table;
  return fmt::format("<details{}><summary>Table: {}</summary>{}</details>\n",
                     figure.view == TableView::printed ? " class=\"printed\"" : "", escaped(figure.title),
                     table);
}

}  // namespace

std::string chart_html(const Chart& chart) {
  return legend_html(chart.series) + svg_element(draw(chart));
}

std::string panorama_html(const Drawing& drawing) {
  return "<div class=\"panorama\">" + svg_element(drawing) + "</div>\n";
}

std::string to_html(const Figure& figure) {
  return fmt::format(
      "<figure id=\"{}\"{}><h3>{}</h3>\n<div "
      "class=\"pictures\">{}</div>\n<figcaption>{}</figcaption>\n{}</figure>\n",
      figure.id, figure.wide ? " class=\"wide\"" : "", escaped(figure.title), figure.pictures,
      escaped(figure.caption), table_html(figure));
}

std::string figures_html(const std::vector<Figure>& figures) {
  std::string html = "<div class=\"figures\">\n";
  for (const Figure& figure : figures) html += to_html(figure);
  return html + "</div>\n";
}

std::string section_html(std::string_view id, std::string_view heading, std::string_view body) {
  return fmt::format("<section id=\"{}\"><h2>{}</h2>\n{}</section>\n", id, escaped(heading), body);
}

std::string paragraph(std::string_view text, std::string_view css_class) {
  return css_class.empty() ? fmt::format("<p>{}</p>\n", escaped(text))
                           : fmt::format("<p class=\"{}\">{}</p>\n", css_class, escaped(text));
}

std::string terms_html(const std::vector<std::pair<std::string, std::string>>& terms) {
  std::string html = "<dl>\n";
  for (const auto& [term, meaning] : terms)
    html += fmt::format("<dt>{}</dt><dd>{}</dd>\n", escaped(term), escaped(meaning));
  return html + "</dl>\n";
}

std::string html_page(std::string_view title, std::string_view body) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>{0}</title>\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"{1}\">\n"
      "<link rel=\"icon\" href=\"data:,\">\n<style>\n{2}{3}</style>\n</head>\n"
      "<body>\n<h1>{0}</h1>\n{4}<div id=\"tip\" role=\"status\" "
      "hidden></div>\n<script>\n{5}</script>\n</body>\n"
      "</html>\n",
      escaped(title), kPolicy, drawing_style(), page_style(), body, page_script());
}

}  // namespace voussoir
