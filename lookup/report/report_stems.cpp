#include "lookup/report/report_stems.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>

#include "core/geometry/box.h"
#include "core/units.h"
#include "lookup/report/drawing/axis.h"

namespace voussoir {
namespace {

constexpr double kSensorDisc = 3.0;
constexpr double kLongestStem = 46.0;    // of what is not cut
constexpr double kBetweenSensors = 7.0;  // of one place
constexpr double kSamePlace = 0.02;      // [m]
constexpr double kAboveBridge = 16.0;    // free between the bridge and the top's lines
constexpr double kNameHeight = 14.0;
constexpr std::size_t kMostNamed = 5;      // of those that do not disagree
constexpr double kTimesOfFifth = 5.0;      // the fifth largest reading: what is larger is cut
constexpr std::size_t kFewestForCut = 10;  // readings

/// Whether the picture shows the reading as a line: heights, under the first load if there are several.
bool hangs(const PicturedAnswer& report, std::size_t point) {
  return quantity_of(report.comparison, point) == Quantity::uy &&
         (report.comparison.load.empty() || report.comparison.load[point] == report.comparison.load.front());
}

/// The points that have lines, the longest first.
std::vector<std::size_t> longest_first(const PicturedAnswer& report) {
  std::vector<std::size_t> points;
  for (std::size_t point = 0; point < report.shown.reading.size(); ++point)
    if (hangs(report, point) && !std::isnan(report.shown.reading[point])) points.push_back(point);
  std::ranges::stable_sort(points, std::ranges::greater{},
                           [&](std::size_t point) { return std::abs(report.shown.reading[point]); });
  return points;
}

/// The reading [m] whose line is as long as lines are; 0 if all are.
double longest_reading(const PicturedAnswer& report) {
  const std::vector<std::size_t> points = longest_first(report);
  if (points.empty()) return 0.0;
  const double largest = std::abs(report.shown.reading[points.front()]);
  if (points.size() < kFewestForCut) return largest;
  const double fifth = std::abs(report.shown.reading[points[4]]);
  return fifth > 0.0 ? std::min(largest, kTimesOfFifth * fifth) : largest;
}

/// Where lines are and how long; the parts of the picture share it.
class Stems {
 public:
  Stems(const PicturedAnswer& report, const BridgeFrame& frame)
      : report_(report),
        frame_(frame),
        is_lifted_(shown_stems(report).lifted),
        height_above_(room_for_stems(report) - kAboveBridge - kLongestStem),
        longest_(longest_reading(report)),
        shift_(shifts()) {}

  std::string elements() {
    std::string text = line_above();
    for (std::size_t point = 0; point < report_.library.points.size(); ++point) text += element(point);
    return text + names();
  }

 private:
  /// Sensors in one place stand side by side.
  std::vector<double> shifts() const {
    const auto& points = report_.library.points;
    std::vector<double> shift(points.size(), 0.0);
    for (std::size_t i = 0; i < points.size(); ++i) {
      double before = 0.0, all = 0.0;
      for (std::size_t k = 0; k < points.size(); ++k) {
        if ((points[k].position - points[i].position).norm() > kSamePlace || is_of_other_load(k)) continue;
        before += k < i ? 1.0 : 0.0;
        all += 1.0;
      }
      if (!is_of_other_load(i)) shift[i] = kBetweenSensors * (before - 0.5 * (all - 1.0));
    }
    return shift;
  }

  bool is_of_other_load(std::size_t point) const {
    const std::vector<std::string>& load = report_.comparison.load;
    return !load.empty() && load[point] != load.front();
  }

  Point place(std::size_t point) const {
    Point at = frame_(report_.library.points[point].position) + Point(shift_[point], 0.0);
    if (site_of(report_, point) == Site::top) at.y() = height_above_;
    return at;
  }

  /// What the top's lines hang from.
  std::string line_above() const {
    if (!is_lifted_) return "";
    return path_element("grid", fmt::format("M{:.1f} {:.1f}H{:.1f}", 8.0, height_above_, frame_.width - 8.0));
  }

  /// [units] downwards; of what is cut as long as lines are.
  double length(std::size_t point) const {
    const double reading = report_.shown.reading[point];
    if (!hangs(report_, point) || std::isnan(reading) || longest_ == 0.0) return 0.0;
    return -kLongestStem * std::clamp(reading / longest_, -1.0, 1.0);
  }

  bool is_cut(std::size_t point) const {
    return hangs(report_, point) && std::abs(report_.shown.reading[point]) > longest_;
  }

  std::string element(std::size_t point) const {
    const Point at = place(point);
    const bool silent = std::isnan(report_.shown.reading[point]);
    const int colour = disagrees(report_, point) ? 2 : 1;
    std::string data = fmt::format("M{:.1f} {:.1f}v{:.2f}", at.x(), at.y(), length(point));
    if (is_cut(point)) data += fmt::format("m-4 {0:.0f}l4 {1:.0f}l4 {0:.0f}", back(point), -back(point));
    const bool has_line = !silent && hangs(report_, point);
    return (has_line ? path_element(fmt::format("line s{}", colour), data) : "") +
           fmt::format("<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\">{}</circle>\n",
                       silent ? "silent" : fmt::format("f{}", colour), at.x(), at.y(), kSensorDisc,
                       tip_element(point_tip(report_, point)));
  }

  double back(std::size_t point) const { return length(point) > 0.0 ? -5.0 : 5.0; }

  /// All that disagree, then the longest.
  std::string names() {
    std::string text;
    for (std::size_t point = 0; point < report_.library.points.size(); ++point)
      if (disagrees(report_, point)) text += name(point);
    const std::vector<std::size_t> points = longest_first(report_);
    for (const std::size_t point : std::span(points).first(std::min(points.size(), kMostNamed)))
      if (!disagrees(report_, point)) text += name(point);
    return text;
  }

  /// Beyond the line's end, or, if a name is there, nowhere.
  std::string name(std::size_t point) {
    const std::string& words = report_.library.points[point].name;
    const double down = length(point);
    const Point end = place(point) + Point(0.0, down + (down > 0.0 ? 13.0 : down < 0.0 ? -5.0 : -7.0));
    const double half = 3.8 * static_cast<double>(words.size());
    const double x = std::clamp(end.x(), half, frame_.width - half);
    const Box box(Point(x - half, end.y() - 10.0), Point(x + half, end.y() + 2.0));
    if (std::ranges::any_of(taken_, [&](const Box& other) { return other.intersects(box); })) return "";
    taken_.push_back(box);
    return text_element({x, end.y()}, "middle", "label sensor", words);
  }

  const PicturedAnswer& report_;
  const BridgeFrame& frame_;
  bool is_lifted_;
  double height_above_;  // of the line that the top's lines hang from
  double longest_;
  std::vector<double> shift_;
  std::vector<Box> taken_;
};

}  // namespace

double room_for_stems(const PicturedAnswer& report) {
  const ShownStems shown = shown_stems(report);
  return shown.lifted ? kNameHeight + 2.0 * kLongestStem + kAboveBridge : 1.5 * kNameHeight;
}

std::string stem_elements(const PicturedAnswer& report, const BridgeFrame& frame) {
  return Stems(report, frame).elements();
}

std::string stem_scale(const PicturedAnswer& report, const Point& at) {
  const double longest = longest_reading(report);
  if (longest <= 0.0) return "";
  const double shown = round_below(kMillimetres * longest);
  const double length = kLongestStem * shown / (kMillimetres * longest);
  return path_element("line s1",
                      fmt::format("M{0:.1f} {1:.1f}h10m-5 0v{2:.1f}m-5 0h10", at.x(), at.y(), length)) +
         text_element(at + Point(16.0, 0.5 * length + 5.0), "start", "small", fmt::format("{:g} mm", shown));
}

bool cuts_stems(const PicturedAnswer& report) {
  const std::vector<std::size_t> points = longest_first(report);
  return !points.empty() && std::abs(report.shown.reading[points.front()]) > longest_reading(report);
}

ShownStems shown_stems(const PicturedAnswer& report) {
  ShownStems shown;
  for (std::size_t point = 0; point < report.library.points.size(); ++point) {
    const bool is_read = !std::isnan(report.shown.reading[point]);
    shown.silent |= !is_read;
    shown.odd |= disagrees(report, point);
    shown.lines |= is_read && hangs(report, point);
    shown.lifted |= hangs(report, point) && site_of(report, point) == Site::top;
  }
  return shown;
}

}  // namespace voussoir
