#include "core/geometry/facing_edges.h"

#include <algorithm>
#include <cmath>

namespace voussoir {

std::optional<FacingStretch> facing_stretch(const Edge& first, const Edge& second, double tolerance) {
  const Point along = first.to - first.from;
  const double length = along.norm();
  const Point back = second.to - second.from;
  if (along.dot(back) >= 0.0) return std::nullopt;
  const auto place = [&](const Point& p) { return (p - first.from).dot(along) / (length * length); };
  const auto distance = [&](const Point& p) { return cross(along, p - first.from) / length; };

  // The second runs backwards: its end comes first along the first.
  const double second_begin = place(second.to);
  const double second_end = place(second.from);
  const double begin = std::max(0.0, second_begin);
  const double end = std::min(1.0, second_end);
  if ((end - begin) * length < tolerance) return std::nullopt;
  const auto on_second = [&](double s) { return (second_end - s) / (second_end - second_begin); };
  for (const double s : {begin, end})
    if (std::abs(distance(second.from + on_second(s) * back)) > tolerance) return std::nullopt;
  return FacingStretch{{begin, end}, {on_second(begin), on_second(end)}, (end - begin) * length};
}

}  // namespace voussoir
