#pragma once
/// @file Pages: one HTML file with everything in it, which fetches nothing.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lookup/report/drawing/chart.h"
#include "lookup/report/drawing/svg.h"
#include "lookup/report/drawing/table.h"

namespace voussoir {

enum class TableView {
  folded,   ///< opens when asked for; not printed
  printed,  ///< opens when asked for; printed
  open
};

/// Pictures with the table that says the same in numbers.
struct Figure {
  std::string id;  ///< unique on the page
  std::string title;
  std::string caption;
  std::string pictures;  ///< HTML: see chart_html and svg_element
  Table table;
  bool wide = false;  ///< takes the page's whole width
  TableView view = TableView::folded;
  int digits = 4;  ///< of the table's numbers
};

/// A chart with its legend.
std::string chart_html(const Chart& chart);

/// A wide picture, whose writing grows on a phone.
std::string panorama_html(const Drawing& drawing);

/// A <figure>.
std::string to_html(const Figure& figure);

/// Figures side by side where there is room.
std::string figures_html(const std::vector<Figure>& figures);

/// A heading of the second order and what follows it; `body` is HTML.
std::string section_html(std::string_view id, std::string_view heading, std::string_view body);

/// <p>; the text is escaped.
std::string paragraph(std::string_view text, std::string_view css_class = {});

/// Terms and what they are, as a definition list.
std::string terms_html(const std::vector<std::pair<std::string, std::string>>& terms);

/// The whole page. `body` is HTML; the title is escaped.
std::string html_page(std::string_view title, std::string_view body);

}  // namespace voussoir
