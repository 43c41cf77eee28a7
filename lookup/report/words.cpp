#include "lookup/report/words.h"

#include <fmt/format.h>

#include <cmath>

#include "core/geometry/box.h"

namespace voussoir {

std::string ordinal(int number) {
  const int last_two = number % 100;
  const int last = number % 10;
  if (last_two >= 11 && last_two <= 13) return fmt::format("{}th", number);
  return fmt::format("{}{}", number, last == 1 ? "st" : last == 2 ? "nd" : last == 3 ? "rd" : "th");
}

std::string percent(double share) {
  if (share < 0.001) return "< 0.1 %";
  if (share > 0.999) return "> 99.9 %";
  return fmt::format("{:.1f} %", 100.0 * share);
}

std::string place_in_words(BlockId id, const BlockLayout& layout) {
  const Block& block = layout[id];
  const Box around = box_of(block.polygon);
  const auto metres = [](double value) { return 1e-4 * std::round(1e4 * value) + 0.0; };  // no -0, no 1e-17
  const std::string box =
      fmt::format("x {:.4g}..{:.4g} m, y {:.4g}..{:.4g} m", metres(around.min().x()),
                  metres(around.max().x()), metres(around.min().y()), metres(around.max().y()));
  if (block.index.course > 0)
    return fmt::format("course {}, {} from the left, {}", block.index.course, ordinal(block.index.position),
                       box);
  if (block.index.course < 0) return fmt::format("block {}, {}", block.label, box);
  return fmt::format("{} {} of {} of the arch, {}", block.kind == BlockKind::leg ? "leg block" : "voussoir",
                     block.index.position, layout.last_position(0), box);
}

std::string place_in_words(const Scene& scene, const BlockLayout& layout) {
  if (scene.removed.empty()) return "no block is missing";
  std::string result;
  for (const BlockId id : scene.removed) result += (result.empty() ? "" : "; ") + place_in_words(id, layout);
  return result;
}

}  // namespace voussoir
