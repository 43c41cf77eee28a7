#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/geometry/box.h"
#include "core/text.h"
#include "lookup/report/drawing/bridge_drawing.h"
#include "lookup/report/drawing/colour_map.h"
#include "lookup/report/plan_report.h"
#include "lookup/report/plan_words.h"
#include "lookup/report/words.h"

namespace voussoir {
namespace {

constexpr double kPlanWidth = 1040.0;
constexpr double kRoomForNames = 58.0;  // above the bridge
constexpr double kPlanDisc = 4.0;
constexpr double kPlanTitle = 42.0;  // height
constexpr double kUnknownKey = 30.0;
constexpr double kNameRow = 15.0;

BlockLook look_of(const SensorPlan& plan, const Database& database, BlockId block) {
  const auto sight = std::ranges::find(plan.sights, block, &Sight::block);
  const std::string heading = fmt::format("Block ({})\n{}\n", database.layout()[block].label,
                                          place_in_words(block, database.layout()));
  if (sight == plan.sights.end())
    return {"stone",
            heading + (std::ranges::find(plan.falls, block) != plan.falls.end() ? "something falls without it"
                                                                                : "not known")};
  return {fmt::format("block m{}", colour_level(sight->seen)),
          heading + fmt::format("its loss is seen with {}, named with {}", percent(sight->seen),
                                percent(sight->named))};
}

/// Sensors at one place, of two blocks that meet there, have one disc and both names.
struct NamedPlace {
  Point at;
  std::string names;
};

std::vector<NamedPlace> sensor_places(const SensorPlan& plan, const Database& database,
                                      const BridgeFrame& frame) {
  std::vector<NamedPlace> places;
  for (const StoredPoint& point : database.control_points()) {
    if (!is_read(plan, point)) continue;
    const Point at = frame(point.position);
    const auto same =
        std::ranges::find_if(places, [&](const NamedPlace& place) { return (place.at - at).norm() < 1.0; });
    if (same == places.end())
      places.push_back({at, point.name});
    else
      same->names += ", " + point.name;
  }
  return places;
}

/// Writes names of places where they cover no other name and no disc: above, in up to three rows, below or
/// beside. Counts those that have no room.
class PlaceNames {
 public:
  PlaceNames(const std::vector<NamedPlace>& places, const BridgeFrame& frame) : frame_(frame) {
    for (const NamedPlace& place : places) taken_.push_back(around(place.at, kPlanDisc, kPlanDisc));
    for (const NamedPlace& place : places) add(place);
  }
  const std::string& elements() const { return elements_; }
  std::size_t left_out() const { return left_out_; }

 private:
  static Box around(const Point& middle, double half_width, double half_height) {
    const Point half(half_width, half_height);
    return {middle - half, middle + half};
  }

  void add(const NamedPlace& place) {
    const double half = 4.0 * static_cast<double>(place.names.size()) + 2.0;
    const bool is_on_top = place.at.y() < kRoomForNames + 1.0;
    const Point above(0.0, -12.0), higher(0.0, above.y() - kNameRow), highest(0.0, higher.y() - kNameRow);
    const Point below(0.0, 14.0), right(half + 8.0, 0.0), left(-half - 8.0, 0.0);
    const std::array<Point, 6> shifts = is_on_top ? std::array{above, higher, highest, below, right, left}
                                                  : std::array{below, above, right, left, higher, highest};
    for (const Point& shift : shifts) {
      Point middle = place.at + shift;
      middle.x() = std::clamp(middle.x(), half, frame_.width - half);
      const Box box = around(middle, half, 6.5);
      const bool is_covered =
          std::ranges::any_of(taken_, [&](const Box& other) { return other.intersects(box); });
      if (is_covered || box.min().y() < 0.0 || box.max().y() > frame_.height) continue;
      taken_.push_back(box);
      if (shift.y() < -12.0)  // the name stands farther away: a line leads to it
        elements_ += path_element("axis", fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", place.at.x(),
                                                      place.at.y(), middle.x(), middle.y() + 6.0));
      elements_ += text_element(middle + Point(0.0, 4.5), "middle", "label", place.names);
      return;
    }
    ++left_out_;
  }

  const BridgeFrame& frame_;
  std::vector<Box> taken_;
  std::string elements_;
  std::size_t left_out_ = 0;
};

std::string discs(const std::vector<NamedPlace>& places) {
  std::string elements;
  for (const NamedPlace& place : places)
    elements += fmt::format("<circle class=\"f1\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\">{}</circle>\n",
                            place.at.x(), place.at.y(), kPlanDisc, tip_element(place.names));
  return elements;
}

/// What is planned, and under which assumptions.
std::string headings(const SensorPlan& plan, const PlannedBridge& bridge, std::size_t unnamed) {
  std::string second = "The bridge is " + conditions_in_words(bridge) + ".";
  if (unnamed > 0)
    second += fmt::format(" Names at {} place{} have no room here.", unnamed, unnamed == 1 ? "" : "s");
  return text_element({8.0, 17.0}, "start", "",
                      fmt::format("{}: {}", bridge.database.bridge_name(), planned_in_words(plan, bridge))) +
         text_element({8.0, 35.0}, "start", "small", second);
}

std::string keys(const SensorPlan& plan, const Drawing& drawing) {
  const double bottom = drawing.height - (plan.unknown.empty() ? 0.0 : kUnknownKey);
  std::string elements =
      colour_bar({"chance that the block's loss is seen", percent_marks(), plan.falls.empty() ? "" : "falls"},
                 drawing.width, bottom);
  if (!plan.unknown.empty())
    elements += stripes_key({0.36 * drawing.width, bottom + 6.0}, "what its loss shows is not known");
  return elements;
}

}  // namespace

std::string plan_picture(const SensorPlan& plan, const PlannedBridge& bridge) {
  const BlockLayout& layout = bridge.database.layout();
  const BridgeFrame frame = frame_below(kRoomForNames, layout, kPlanWidth);
  Drawing drawing{frame.width,
                  kPlanTitle + frame.height + kColourBarHeight + (plan.unknown.empty() ? 0.0 : kUnknownKey),
                  "The bridge; each block coloured by the chance that its loss is seen, and the sensors", ""};
  const std::vector<NamedPlace> places = sensor_places(plan, bridge.database, frame);
  const PlaceNames names(places, frame);
  drawing.elements =
      headings(plan, bridge, names.left_out()) +
      fmt::format("<g transform=\"translate(0 {})\">\n", kPlanTitle) + ground_element(layout, frame) +
      block_elements(layout, frame, [&](BlockId block) { return look_of(plan, bridge.database, block); }) +
      striped_blocks(plan.unknown, layout, frame) + discs(places) + names.elements() + "</g>\n" +
      keys(plan, drawing);
  return svg_file(drawing);
}

}  // namespace voussoir
