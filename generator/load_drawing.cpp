#include "generator/load_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <vector>

#include "core/structure/loads.h"
#include "core/text.h"
#include "core/units.h"

namespace voussoir {
namespace {

constexpr double kArrow = 0.5 * kLoadRow;
constexpr double kSignWidth = 5.4;  // [px]

/// Where a load case pushes; of the ends of a line no force of its own [N].
struct Push {
  double x = 0.0;
  std::optional<double> force;
};

/// Points, a vehicle's axles at the first place and ends of lines, those on the bridge, from left to right.
std::vector<Push> pushes_of(const LoadDescription& load, const LoadFrame& across) {
  std::vector<Push> pushes;
  for (const PointLoad& point : load.points) pushes.push_back({point.x, point.force});
  if (!load.places.empty())
    for (const Axle& axle : load.axles) pushes.push_back({load.places.front() - axle.at, axle.force});
  for (const LineLoad& line : load.lines)
    for (const double end : {line.from_x, line.to_x}) pushes.push_back({end, std::nullopt});
  std::erase_if(pushes, [&](const Push& push) { return push.x < across.low || push.x > across.high; });
  std::ranges::stable_sort(pushes, {}, &Push::x);
  return pushes;
}

std::string arrows(const LoadDescription& load, const std::vector<Push>& pushes, double base,
                   const LoadFrame& across) {
  std::string data;
  for (const LineLoad& line : load.lines)
    fmt::format_to(std::back_inserter(data), "M{:.1f} {:.1f}H{:.1f}", across(line.from_x), base - kArrow,
                   across(line.to_x));
  for (const Push& push : pushes)
    fmt::format_to(std::back_inserter(data), "M{:.1f} {:.1f}v{:.1f}m-3 -6l3 6l3 -6", across(push.x),
                   base - kArrow, kArrow);
  return data;
}

/// Beside the arrows, where the next one leaves room; nothing if there is only one.
std::string forces(const std::vector<Push>& pushes, double base, const LoadFrame& across) {
  std::string elements;
  for (std::size_t i = 0; pushes.size() > 1 && i < pushes.size(); ++i) {
    if (!pushes[i].force) continue;
    const std::string text = fmt::format("{:.4g} kN", kKilonewtons * *pushes[i].force);
    const double at = across(pushes[i].x) + 6.0;
    const double next = i + 1 < pushes.size() ? across(pushes[i + 1].x) : across.width;
    if (at + kSignWidth * static_cast<double>(text.size()) < next)
      elements += text_at({at, base - 3.0}, "start", text);
  }
  return elements;
}

/// "truck@1: 160 kN over 3 m, 53.3 kN of it on the model's 1 m": the bridge carries what falls to its
/// thickness of the load's width.
std::string load_in_words(const LoadDescription& load, const LoadStage& stage, double thickness) {
  const double carried = -kKilonewtons * stage.force.row(1).sum() + 0.0;
  if (!load.width || *load.width == thickness)
    return fmt::format("{}: {:.4g} kN on the model's {:g} m", stage.name, carried, thickness);
  return fmt::format("{}: {:.4g} kN over {:g} m, {:.3g} kN of it on the model's {:g} m", stage.name,
                     carried * *load.width / thickness, *load.width, carried, thickness);
}

}  // namespace

std::string text_at(const Point& at, const char* css_class, const std::string& text) {
  return fmt::format("<text class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", css_class, at.x(), at.y(),
                     escaped(text));
}

std::string load_elements(const Model& bridge, const BridgeDescription& description,
                          const LoadFrame& across) {
  std::string elements;
  double base = across.top - 0.3 * kLoadRow - kLoadRow * static_cast<double>(description.loads.size());
  for (const LoadDescription& load : description.loads) {
    base += kLoadRow;
    const LoadStage stage = load_stages(load, bridge, description.material.thickness).front();
    const std::string words = load_in_words(load, stage, description.material.thickness);
    const std::vector<Push> pushes = pushes_of(load, across);
    double middle = 0.5 * across.width;
    if (!pushes.empty()) middle = 0.5 * (across(pushes.front().x) + across(pushes.back().x));
    const double half = 0.5 * kSignWidth * static_cast<double>(words.size());
    elements += fmt::format("<path class=\"load\" d=\"{}\"><title>{}</title></path>\n",
                            arrows(load, pushes, base, across), escaped(words)) +
                forces(pushes, base, across) +
                text_at({std::clamp(middle, half, std::max(half, across.width - half)), base - kArrow - 3.0},
                        "", words);
  }
  return elements;
}

}  // namespace voussoir
