#include "lookup/report/drawing/svg.h"

#include <fmt/format.h>

#include <iterator>

#include "core/text.h"
#include "lookup/report/drawing/style.h"

namespace voussoir {
namespace {

/// Opens <svg>, without its last angle bracket.
std::string opening(const Drawing& drawing, std::string_view more) {
  return fmt::format("<svg viewBox=\"0 0 {:.6g} {:.6g}\" role=\"img\" aria-label=\"{}\"{}>", drawing.width,
                     drawing.height, escaped(drawing.label), more);
}

}  // namespace

std::string svg_element(const Drawing& drawing) {
  const std::string size = fmt::format(" style=\"max-width:{:.6g}px\"", drawing.width);
  return opening(drawing, size) + "\n" + drawing.elements + "</svg>\n";
}

std::string svg_file(const Drawing& drawing) {
  const std::string more =
      fmt::format(" xmlns=\"http://www.w3.org/2000/svg\" width=\"{:.6g}\" height=\"{:.6g}\"", drawing.width,
                  drawing.height);
  return opening(drawing, more) + "\n<style>\n" + drawing_style() +
         "</style>\n<rect class=\"page\" width=\"100%\" height=\"100%\"/>\n" + drawing.elements + "</svg>\n";
}

std::string open_path(std::span<const Point> points) {
  std::string data;
  for (const Point& point : points)
    fmt::format_to(std::back_inserter(data), "{}{:.1f} {:.1f}", data.empty() ? 'M' : 'L', point.x(),
                   point.y());
  return data;
}

std::string closed_path(std::span<const Point> points) {
  return open_path(points) + "Z";
}

std::string tip_element(std::string_view text) {
  return text.empty() ? "" : fmt::format("<title>{}</title>", escaped(text));
}

std::string path_element(std::string_view css_class, std::string_view data, std::string_view tip) {
  if (tip.empty()) return fmt::format("<path class=\"{}\" d=\"{}\"/>\n", css_class, data);
  return fmt::format("<path class=\"{}\" d=\"{}\">{}</path>\n", css_class, data, tip_element(tip));
}

std::string text_element(const Point& at, std::string_view anchor, std::string_view css_class,
                         std::string_view text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" class=\"{}\">{}</text>\n", at.x(),
                     at.y(), anchor, css_class, escaped(text));
}

}  // namespace voussoir
