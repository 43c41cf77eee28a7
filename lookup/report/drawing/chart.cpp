#include "lookup/report/drawing/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/geometry/box.h"
#include "core/text.h"

namespace voussoir {
namespace {

constexpr double kLeft = 62.0, kRight = 14.0, kTop = 10.0, kBottom = 46.0;  // margins
constexpr int kTicksAcross = 6;
constexpr int kTicksUp = 6;
constexpr double kDisc = 3.4;
constexpr double kLegendLine = 22.0;
constexpr double kLegendSample = 30.0;
constexpr double kLetter = 7.2;  // width of one, about
constexpr double kTickHalf = 8.0;
constexpr double kHollow = 4.2;
constexpr double kBetweenNames = 12.0;

struct Axes {
  AxisMap x, y;
  Point operator()(double at_x, double at_y) const { return {x(at_x), y(at_y)}; }
};

AxisMap axis_of(const ChartAxis& axis, const std::vector<double>& values, int ticks, double begin,
                double end) {
  if (axis.range) return {axis.range->first, axis.range->second, begin, end, axis.scale};
  return axis_over(values, axis.scale, ticks, begin, end);
}

Axes axes_of(const Chart& chart) {
  std::vector<double> x, y;
  for (const Series& series : chart.series) {
    x.insert(x.end(), series.x.begin(), series.x.end());
    y.insert(y.end(), series.y.begin(), series.y.end());
    y.insert(y.end(), series.upper.begin(), series.upper.end());
  }
  return {axis_of(chart.x, x, kTicksAcross, kLeft, chart.width - kRight),
          axis_of(chart.y, y, kTicksUp, chart.height - kBottom, kTop)};
}

/// An attribute for a text that would be longer than it may [px].
std::string squeezed(const std::string& text, double most) {
  constexpr double kSign = 6.6;  // [px], on average
  return kSign * static_cast<double>(text.size()) > most
             ? fmt::format(" textLength=\"{:.0f}\" lengthAdjust=\"spacingAndGlyphs\"", most - 6.0)
             : "";
}

std::vector<Tick> ticks_on(const ChartAxis& axis, const AxisMap& map, int count) {
  return axis.ticks.empty() ? ticks_of(map, count) : axis.ticks;
}

std::string grid(const Chart& chart, const Axes& axes) {
  std::string text;
  for (const Tick& tick : ticks_on(chart.x, axes.x, kTicksAcross)) {
    const double x = axes.x(tick.value);
    text += path_element("grid", fmt::format("M{:.1f} {:.1f}V{:.1f}", x, axes.y.begin, axes.y.end));
    text += text_element({x, axes.y.begin + 17.0}, "middle", "small", tick.text);
  }
  for (const Tick& tick : ticks_on(chart.y, axes.y, kTicksUp)) {
    const double y = axes.y(tick.value);
    text += path_element("grid", fmt::format("M{:.1f} {:.1f}H{:.1f}", axes.x.begin, y, axes.x.end));
    text += text_element({axes.x.begin - 7.0, y + 4.0}, "end", "small", tick.text);
  }
  text += path_element("axis", fmt::format("M{:.1f} {:.1f}V{:.1f}H{:.1f}", axes.x.begin, axes.y.end,
                                           axes.y.begin, axes.x.end));
  const double middle = 0.5 * (axes.y.begin + axes.y.end);
  text += text_element({0.5 * (axes.x.begin + axes.x.end), chart.height - 8.0}, "middle", "", chart.x.label);
  return text +
         fmt::format(
             "<text x=\"14\" y=\"{0:.1f}\" text-anchor=\"middle\"{2} transform=\"rotate(-90 14 {0:.1f})\">{1}"
             "</text>\n",
             middle, escaped(chart.y.label),
             squeezed(chart.y.label, 2.0 * std::min(middle, chart.height - middle)));
}

bool drawable(const Series& series, std::size_t i, const Axes& axes) {
  const auto fits = [](double value, const AxisMap& axis) {
    return std::isfinite(value) && (axis.scale == AxisScale::linear || value > 0.0);
  };
  return fits(series.x[i], axes.x) && fits(series.y[i], axes.y);
}

std::string line_class(const Series& series) {
  const char* pattern = series.mark == Mark::dashes ? " dashed" : series.mark == Mark::dots ? " dotted" : "";
  return fmt::format("line s{}{}", series.colour, pattern);
}

std::string tick_data(const Point& at) {
  return fmt::format("M{:.1f} {:.1f}h{}", at.x() - kTickHalf, at.y(), 2.0 * kTickHalf);
}

std::string line(const Series& series, const Axes& axes) {
  std::string data;
  std::vector<Point> stretch;
  for (std::size_t i = 0; i <= series.x.size(); ++i) {
    if (i < series.x.size() && drawable(series, i, axes)) {
      stretch.push_back(axes(series.x[i], series.y[i]));
    } else {
      data += stretch.size() == 1 ? tick_data(stretch.front()) : open_path(stretch);
      stretch.clear();
    }
  }
  return path_element(line_class(series), data);
}

std::string ticks(const Series& series, const Axes& axes) {
  std::string data;
  for (std::size_t i = 0; i < series.x.size(); ++i)
    if (drawable(series, i, axes)) data += tick_data(axes(series.x[i], series.y[i]));
  return path_element(line_class(series), data);
}

/// The outline of a band over the values from `begin` to `end`; over a single value a narrow column.
std::string band_outline(const Series& series, const Axes& axes, std::size_t begin, std::size_t end) {
  const Point half = end - begin == 1 ? Point(kTickHalf, 0.0) : Point(0.0, 0.0);
  std::vector<Point> outline;
  for (std::size_t i = begin; i < end; ++i) outline.push_back(axes(series.x[i], series.y[i]) - half);
  if (end - begin == 1) outline.push_back(outline.back() + 2.0 * half);
  for (std::size_t i = end; i-- > begin;) outline.push_back(axes(series.x[i], series.upper[i]) + half);
  if (end - begin == 1) outline.push_back(outline.back() - 2.0 * half);
  return closed_path(outline);
}

std::string band(const Series& series, const Axes& axes) {
  std::string data;
  for (std::size_t i = 0; i < series.x.size();) {
    std::size_t end = i;
    while (end < series.x.size() && drawable(series, end, axes)) ++end;
    if (end > i) data += band_outline(series, axes, i, end);
    i = end + 1;
  }
  return path_element(fmt::format("band f{}", series.colour), data);
}

std::string tip_of(const Series& series, std::size_t i) {
  if (i < series.tips.size()) return series.tips[i];
  return fmt::format("{}{}{:.6g}, {:.6g}{}{}", series.name, series.name.empty() ? "" : ": ", series.x[i],
                     series.y[i], i < series.notes.size() ? "\n" : "",
                     i < series.notes.size() ? series.notes[i] : "");
}

std::string discs(const Series& series, const Axes& axes) {
  std::string text;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (!drawable(series, i, axes)) continue;
    const Point at = axes(series.x[i], series.y[i]);
    text += fmt::format("<circle class=\"f{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\">{}</circle>\n",
                        series.colour, at.x(), at.y(), kDisc, tip_element(tip_of(series, i)));
  }
  return text;
}

std::string hollow_discs(const Series& series, const Axes& axes) {
  std::string text;
  for (std::size_t i = 0; i < series.x.size(); ++i)
    text += fmt::format("<circle class=\"silent\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\">{}</circle>\n",
                        axes.x(series.x[i]), axes.y.begin, kHollow,
                        i < series.tips.size() ? tip_element(series.tips[i]) : "");
  return text;
}

/// Writes notes beside their discs where they cover no other note and no disc; the others are left to the
/// discs' tips.
class Notes {
 public:
  Notes(const Chart& chart, const Axes& axes) : chart_(chart), axes_(axes) {
    for (const Series& series : chart.series)
      if (!series.notes.empty())
        for (std::size_t i = 0; i < series.x.size(); ++i)
          if (drawable(series, i, axes))
            taken_.push_back(around(axes(series.x[i], series.y[i]), kDisc, kDisc));
  }

  std::string elements() {
    std::string text;
    for (const Series& series : chart_.series)
      for (std::size_t i = 0; i < series.notes.size(); ++i)
        if (drawable(series, i, axes_)) text += note(axes_(series.x[i], series.y[i]), series.notes[i]);
    return text;
  }

 private:
  static Box around(const Point& middle, double half_width, double half_height) {
    const Point half(half_width, half_height);
    return {middle - half, middle + half};
  }

  std::string note(const Point& disc, const std::string& words) {
    const double half = 0.5 * kLetter * static_cast<double>(words.size());
    for (const Point& shift :
         {Point(half + 8.0, 0.0), Point(-half - 8.0, 0.0), Point(0.0, 13.0), Point(0.0, -13.0)}) {
      const Box box = around(disc + shift, half, 7.0);
      const bool outside = box.min().x() < kLeft || box.max().x() > chart_.width;
      const bool covers =
          std::any_of(taken_.begin(), taken_.end(), [&](const Box& b) { return b.intersects(box); });
      if (outside || covers) continue;
      taken_.push_back(box);
      return text_element(disc + shift + Point(0.0, 4.0), "middle", "small", words);
    }
    return "";
  }

  const Chart& chart_;
  const Axes& axes_;
  std::vector<Box> taken_;
};

std::string draw_series(const Series& series, const Axes& axes) {
  switch (series.mark) {
    case Mark::band:
      return band(series, axes);
    case Mark::points:
      return discs(series, axes);
    case Mark::beads:
      return line(series, axes) + discs(series, axes);
    case Mark::ticks:
      return ticks(series, axes);
    case Mark::hollow:
      return hollow_discs(series, axes);
    default:
      return line(series, axes);
  }
}

/// What stands for a series in the legend, its left end at (0, middle).
std::string sample(const Series& series, const Point& at) {
  if (series.mark == Mark::band)
    return fmt::format("<rect class=\"band f{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{}\" height=\"10\"/>\n",
                       series.colour, at.x(), at.y() - 5.0, kLegendSample);
  if (series.mark == Mark::hollow)
    return fmt::format("<circle class=\"silent\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\"/>\n",
                       at.x() + 0.5 * kLegendSample, at.y(), kHollow);
  const std::string disc = series.mark == Mark::points || series.mark == Mark::beads
                               ? fmt::format("<circle class=\"f{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\"/>\n",
                                             series.colour, at.x() + 0.5 * kLegendSample, at.y(), kDisc)
                               : "";
  if (series.mark == Mark::points) return disc;
  return path_element(line_class(series), fmt::format("M{:.1f} {:.1f}h{}", at.x(), at.y(), kLegendSample)) +
         disc;
}

}  // namespace

ChartAxis named_axis(const std::string& label, const std::vector<std::string>& names) {
  const double room = (Chart{}.width - kLeft - kRight) / static_cast<double>(names.size());  // of one name
  std::size_t longest = 1;
  for (const std::string& name : names) longest = std::max(longest, name.size());
  const double needed = kLetter * static_cast<double>(longest) + kBetweenNames;
  ChartAxis axis{label, AxisScale::linear, {{0.4, static_cast<double>(names.size()) + 0.6}}};
  double last = -needed;  // where the name before stands
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double at = room * static_cast<double>(i);
    if (names[i].empty() || at - last < needed) continue;
    axis.ticks.push_back({static_cast<double>(i + 1), names[i]});
    last = at;
  }
  return axis;
}

Drawing draw(const Chart& chart) {
  const Axes axes = axes_of(chart);
  std::string elements = grid(chart, axes);
  for (const Series& series : chart.series)
    if (series.mark == Mark::band) elements += draw_series(series, axes);
  for (const Series& series : chart.series)
    if (series.mark != Mark::band) elements += draw_series(series, axes);
  elements += Notes(chart, axes).elements();
  return {chart.width, chart.height, chart.label, elements};
}

Drawing draw_with_legend(const Chart& chart) {
  std::string legend;
  Point at(kLeft, 0.7 * kLegendLine);
  for (const Series& series : chart.series) {
    if (series.name.empty()) continue;
    const double width = kLegendSample + 26.0 + kLetter * static_cast<double>(series.name.size());
    if (at.x() > kLeft && at.x() + width > chart.width) at = Point(kLeft, at.y() + kLegendLine);
    legend += sample(series, at);
    legend += text_element(at + Point(kLegendSample + 6.0, 4.0), "start", "small", series.name);
    at.x() += width;
  }
  Drawing drawing = draw(chart);
  const double height = legend.empty() ? 0.0 : at.y() + 0.5 * kLegendLine;
  drawing.elements =
      legend + fmt::format("<g transform=\"translate(0 {:.1f})\">\n", height) + drawing.elements + "</g>\n";
  drawing.height += height;
  return drawing;
}

std::string legend_html(const std::vector<Series>& series) {
  std::string items;
  for (const Series& one : series)
    if (!one.name.empty())
      items += fmt::format("<li><svg viewBox=\"0 0 34 12\" aria-hidden=\"true\">{}</svg>{}</li>\n",
                           sample(one, {2.0, 6.0}), escaped(one.name));
  return items.empty() ? "" : "<ul class=\"legend\">" + items + "</ul>\n";
}

}  // namespace voussoir
