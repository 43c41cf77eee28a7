#pragma once
/// @file Pictures as SVG text. Colours are classes of one style sheet (style.h), so that a picture follows a
/// light and a dark page.

#include <span>
#include <string>
#include <string_view>

#include "core/geometry/polygon.h"

namespace voussoir {

/// A picture: elements in a frame of width x height units (pixels at full size), y downwards.
struct Drawing {
  double width = 0.0;
  double height = 0.0;
  std::string label;     ///< what it shows, for people who hear it
  std::string elements;  ///< SVG
};

/// As an element of an HTML page that has the style sheet.
std::string svg_element(const Drawing& drawing);

/// As a file of its own, with the style sheet and a background.
std::string svg_file(const Drawing& drawing);

/// Points (in units of the frame) as the data of a path, open or closed.
std::string open_path(std::span<const Point> points);
std::string closed_path(std::span<const Point> points);

/// <path class= d=>, with a text that appears when it is pointed at, unless that is empty.
std::string path_element(std::string_view css_class, std::string_view data, std::string_view tip = {});

/// A line of text; `anchor` is "start", "middle" or "end".
std::string text_element(const Point& at, std::string_view anchor, std::string_view css_class,
                         std::string_view text);

/// The inside of an element that shows a text when it is pointed at.
std::string tip_element(std::string_view text);

}  // namespace voussoir
