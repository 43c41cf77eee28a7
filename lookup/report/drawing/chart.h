#pragma once
/// @file Charts: lines, bands and points over two axes.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lookup/report/drawing/axis.h"
#include "lookup/report/drawing/svg.h"

namespace voussoir {

enum class Mark {
  line,  ///< a value without neighbours is a tick
  dashes,
  dots,    ///< a dotted line
  points,  ///< one disc a point
  beads,   ///< a line with discs
  ticks,   ///< a short level stroke a point
  hollow,  ///< a hollow disc on the lower axis for each x, whatever y
  band     ///< the area between y and `upper`
};

/// Values in the order they are joined; NaN interrupts a line.
struct Series {
  std::string name;  ///< in the legend; empty: not in the legend
  int colour = 0;    ///< 0 .. kSeriesColours - 1
  Mark mark = Mark::line;
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> upper = {};       ///< of a band
  std::vector<std::string> tips = {};   ///< of points and beads: shown when pointed at; without: the values
  std::vector<std::string> notes = {};  ///< of points: written beside them
};

struct ChartAxis {
  std::string label;  ///< with its unit
  AxisScale scale = AxisScale::linear;
  std::optional<std::pair<double, double>> range = {};  ///< instead of what the values need
  std::vector<Tick> ticks = {};                         ///< instead of round numbers
};

struct Chart {
  std::string label;  ///< what it shows, for people who hear it
  ChartAxis x, y;
  std::vector<Series> series;
  double width = 480.0;
  double height = 300.0;
};

/// An axis of things that have names, numbered from 1, none of them on the frame: each name is written that
/// has room beside the one before. An empty name stands for a gap.
ChartAxis named_axis(const std::string& label, const std::vector<std::string>& names);

/// The chart without a legend.
Drawing draw(const Chart& chart);

/// The chart with its legend above, for a file of its own.
Drawing draw_with_legend(const Chart& chart);

/// The legend as a list in HTML, which wraps on a narrow page; empty if no series has a name.
std::string legend_html(const std::vector<Series>& series);

}  // namespace voussoir
