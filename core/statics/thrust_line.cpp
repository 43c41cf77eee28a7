#include "core/statics/thrust_line.h"

#include <limits>
#include <map>
#include <tuple>

#include "core/structure/block_boxes.h"

namespace voussoir {
namespace {

/// A place below each ring: its middle at the height of its feet.
std::map<int, Point> places_below(const BlockLayout& layout) {
  std::map<int, Point> places;
  for (const auto& [ring, box] : boxes_of_rings(layout.blocks))
    places[ring] = {box.center().x(), box.min().y()};
  return places;
}

ThrustPoint resultant(const std::vector<const JointForces*>& stretches, const Point& below) {
  ThrustPoint point{};
  point.outward = (stretches.front()->ends[1] - stretches.front()->ends[0]).normalized();
  const auto place_along = [&](const Point& place) { return point.outward.dot(place); };
  Point low = stretches.front()->ends[0], high = low;
  for (const JointForces* stretch : stretches)
    for (const Point& end : stretch->ends) {
      if (place_along(end) < place_along(low)) low = end;
      if (place_along(end) > place_along(high)) high = end;
    }
  point.centre = 0.5 * (low + high);
  point.thickness = (high - low).norm();
  if (point.outward.dot(point.centre - below) < 0.0) point.outward = -point.outward;
  double moment = 0.0;
  for (const JointForces* stretch : stretches) {
    const Point along = (stretch->ends[1] - stretch->ends[0]).normalized();
    const Point across(along.y(), -along.x());
    for (std::size_t end = 0; end < 2; ++end) {
      const double normal = stretch->on_second.at(end).dot(across);
      point.normal += normal;
      point.shear += stretch->on_second.at(end).dot(point.outward);
      moment += normal * point.outward.dot(stretch->ends.at(end) - point.centre);
    }
  }
  point.eccentricity = point.normal > 0.0 ? moment / point.normal : std::numeric_limits<double>::quiet_NaN();
  return point;
}

}  // namespace

std::vector<ThrustPoint> thrust_lines(const Structure& structure, const std::vector<JointForces>& joints) {
  const std::map<int, Point> below = places_below(structure.layout);
  using RingJoint = std::tuple<int, BlockId, BlockId>;
  std::map<RingJoint, std::vector<const JointForces*>> of_pair;
  for (const JointForces& stretch : joints) {
    const Joint& joint = structure.joints[stretch.joint];
    const int ring = structure.layout.blocks[static_cast<std::size_t>(value(joint.first))].ring;
    if (ring == kNoRing ||
        structure.layout.blocks[static_cast<std::size_t>(value(joint.second))].ring != ring)
      continue;
    of_pair[{ring, joint.first, joint.second}].push_back(&stretch);
  }
  std::vector<ThrustPoint> points;
  for (const auto& [place, stretches] : of_pair) {
    ThrustPoint point = resultant(stretches, below.at(std::get<0>(place)));
    std::tie(point.ring, point.first, point.second) = place;
    points.push_back(point);
  }
  return points;
}

}  // namespace voussoir
