#include "core/structure/arch.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "core/error.h"
#include "core/geometry/arc_chain.h"
#include "core/geometry/box.h"
#include "core/geometry/circular_arc.h"
#include "core/geometry/ellipse.h"
#include "core/geometry/overlap.h"
#include "core/geometry/spline.h"

namespace voussoir {
namespace {

constexpr double kSameShare = 1e-12;  ///< of the intrados' length: round-off of its division
constexpr double kAtFoot = 1e-9;      ///< [m] an end of the intrados this close to the foot lies on it
constexpr double kFlattest =
    1e-3;  ///< an end whose joint rises by less than this share of its width is level

/// A ring between two curves parallel to the intrados.
struct Ring {
  double inside = 0.0;  ///< [m] offset of its inner face
  double outside = 0.0;
  std::vector<CurvePlace> joints;
};

std::vector<CurvePlace> joint_places(int voussoirs, bool staggered) {
  std::vector<CurvePlace> places;
  const double parts = staggered ? 2.0 * voussoirs : voussoirs;
  if (!staggered)
    for (int j = 0; j <= voussoirs; ++j) places.push_back({static_cast<double>(j), parts});
  else
    for (int j = 0; j <= voussoirs + 1; ++j)  // 0, 1, 3, 5.. 2n - 1, 2n halves
      places.push_back({std::clamp(2.0 * j - 1.0, 0.0, parts), parts});
  return places;
}

std::vector<Ring> rings_of(const SpanDescription& span) {
  std::vector<Ring> rings = {{0.0, span.ring_thickness, joint_places(span.voussoirs, span.staggered)}};
  for (const RingDescription& ring : span.outer_rings) {
    const double inside = rings.back().outside;
    rings.push_back({inside, inside + ring.thickness, joint_places(ring.voussoirs, ring.staggered)});
  }
  return rings;
}

/// The places on the face between two rings, or on the outermost or innermost face, where it bends: joints on
/// both sides and the curve's corner; ascending.
std::vector<CurvePlace> bends_between(const Curve& curve, const Ring* inner, const Ring* outer) {
  std::vector<CurvePlace> places;
  for (const Ring* ring : {inner, outer})
    if (ring != nullptr) places.insert(places.end(), ring->joints.begin(), ring->joints.end());
  if (curve.has_corner) places.push_back({1.0, 2.0});
  std::stable_sort(places.begin(), places.end(),
                   [](const CurvePlace& a, const CurvePlace& b) { return a.share() < b.share(); });
  const auto same = [](const CurvePlace& a, const CurvePlace& b) {
    return b.share() - a.share() < kSameShare;
  };
  places.erase(std::unique(places.begin(), places.end(), same), places.end());
  return places;
}

/// Those strictly between two places, on the curve's parallel at this offset.
std::vector<Point> points_between(const Curve& curve, const std::vector<CurvePlace>& bends, double offset,
                                  const CurvePlace& from, const CurvePlace& to) {
  std::vector<Point> points;
  for (const CurvePlace& place : bends)
    if (place.share() > from.share() + kSameShare && place.share() < to.share() - kSameShare)
      points.push_back(curve.point(place, offset));
  return points;
}

Block ring_block(BlockKind kind, int ring, Polygon polygon) {
  Block block;
  block.role = BlockRole::ring;
  block.ring = ring;
  block.kind = kind;
  block.polygon = std::move(polygon);
  return block;
}

/// Corners in the order outer, inner, inner, outer: intrados from corner 1 on.
Block voussoir_between(const Curve& curve, const Ring& ring, int number, const CurvePlace& from,
                       const CurvePlace& to, const std::vector<CurvePlace>& inner_bends,
                       const std::vector<CurvePlace>& outer_bends) {
  Polygon polygon = {curve.point(from, ring.outside), curve.point(from, ring.inside)};
  for (const Point& p : points_between(curve, inner_bends, ring.inside, from, to)) polygon.push_back(p);
  polygon.push_back(curve.point(to, ring.inside));
  polygon.push_back(curve.point(to, ring.outside));
  const std::vector<Point> above = points_between(curve, outer_bends, ring.outside, from, to);
  polygon.insert(polygon.end(), above.rbegin(), above.rend());
  Block block = ring_block(polygon.size() == 4 ? BlockKind::voussoir : BlockKind::cut, number, polygon);
  if (ring.inside == 0.0) block.intrados = {curve.point(from, 0.0), curve.point(to, 0.0)};
  return block;
}

/// Between normals that cross a voussoir would cross itself, and its straight back where the ring bends much
/// may cut through the ring below.
void check_voussoir(const Block& block, std::size_t number) {
  if (area(block.polygon) <= 0.0 || self_crossing(block.polygon))
    throw InputError(
        fmt::format("voussoir {} of ring {} would be turned inside out: expected thinner "
                    "rings, another number of voussoirs or an intrados that bends less",
                    number, block.ring + 1));
}

/// Where points do not come in their order, a ring goes back and forth.
void check_ring(std::span<const Block> ring) {
  constexpr double kTouching = 1e-6;  // of the smaller voussoir
  for (std::size_t i = 0; i < ring.size(); ++i)
    for (std::size_t j = i + 2; j < ring.size(); ++j) {
      if (!box_of(ring[i].polygon).intersects(box_of(ring[j].polygon))) continue;
      const double smaller = std::min(area(ring[i].polygon), area(ring[j].polygon));
      if (overlap_of(ring[i].polygon, ring[j].polygon).area > kTouching * smaller)
        throw InputError(
            fmt::format("voussoirs {} and {} of ring {} overlap: do the intrados's points come in their "
                        "order from the left springing to the right one?",
                        i + 1, j + 1, ring[i].ring + 1));
    }
}

/// What stands below an end of the ring: from `inner`, the springing, and `outer`, the far end of its last
/// joint, down to `foot`.
struct RingEnd {
  Point inner, outer;
  double foot = 0.0;
  bool has_stone = false;
};

RingEnd ring_end(const SpanDescription& span, const Curve& curve, bool left, bool wall_has_courses) {
  const CurvePlace place{left ? 0.0 : 1.0, 1.0};
  RingEnd end{curve.point(place, 0.0), curve.point(place, thickness_of_rings(span))};
  const double height = span.skewback.value_or(end.inner.y());
  end.foot = end.inner.y();
  if (!has_skewbacks(span, wall_has_courses)) return end;
  end.foot = std::max(0.0, end.inner.y() - height);
  if (std::abs(end.inner.y() - end.foot) < kAtFoot) end.inner.y() = end.foot;
  const bool level = end.outer.y() - end.inner.y() <= kFlattest * std::abs(end.outer.x() - end.inner.x());
  end.has_stone = end.foot < end.inner.y() || !level;
  return end;
}

void add_stone(const RingEnd& end, bool left, std::vector<Block>& blocks) {
  if (!end.has_stone) return;
  const Point outer_foot(end.outer.x(), end.foot), inner_foot(end.inner.x(), end.foot);
  Polygon polygon = left ? Polygon{outer_foot, inner_foot, end.inner, end.outer}
                         : Polygon{inner_foot, outer_foot, end.outer, end.inner};
  polygon.erase(std::unique(polygon.begin(), polygon.end()), polygon.end());
  if (polygon.size() > 1 && polygon.front() == polygon.back()) polygon.pop_back();
  Block stone = ring_block(BlockKind::leg, 0, polygon);
  if (end.foot < end.inner.y())
    stone.intrados = left ? std::array{inner_foot, end.inner} : std::array{end.inner, inner_foot};
  blocks.push_back(std::move(stone));
}

/// Stones, opening and rings in one outline, from the lower left corner.
Polygon enclosed_by(const std::vector<Point>& extrados, const RingEnd& left, const RingEnd& right) {
  Polygon polygon;
  const auto bottom = [&](const RingEnd& end) {
    if (end.foot > 0.0 || (!end.has_stone && end.outer.y() > 0.0))
      polygon.emplace_back(end.inner.x(), 0.0);
    else if (end.has_stone)
      polygon.emplace_back(end.outer.x(), 0.0);
  };
  bottom(left);
  bottom(right);
  if (right.foot > 0.0) polygon.emplace_back(right.inner.x(), right.foot);
  if (right.has_stone && right.foot > 0.0) polygon.emplace_back(right.outer.x(), right.foot);
  polygon.insert(polygon.end(), extrados.rbegin(), extrados.rend());
  if (left.has_stone && left.foot > 0.0) polygon.emplace_back(left.outer.x(), left.foot);
  if (left.foot > 0.0) polygon.emplace_back(left.inner.x(), left.foot);
  return polygon;
}

}  // namespace

Curve intrados_of(const SpanDescription& span) {
  const Point middle(span.centre_x, span.centre_y);
  switch (span.shape) {
    case IntradosShape::segmental:
      return segment_of_circle(middle, span.span, span.rise);
    case IntradosShape::pointed:
      return pointed_arch(middle, span.span, span.rise, span.arc_radius);
    case IntradosShape::three_centred:
      return three_centred_arch(middle, span.span, span.rise, span.arc_radius);
    case IntradosShape::elliptic:
      return half_ellipse(middle, span.span, span.rise);
    case IntradosShape::points:
      return spline_through(span.points);
    case IntradosShape::semicircular:
      break;
  }
  return circular_arc(middle, span.intrados_radius, 0.5 * std::numbers::pi);
}

int ring_count(const SpanDescription& span) {
  return 1 + static_cast<int>(span.outer_rings.size());
}

double thickness_of_rings(const SpanDescription& span) {
  double thickness = span.ring_thickness;
  for (const RingDescription& ring : span.outer_rings) thickness += ring.thickness;
  return thickness;
}

bool has_skewbacks(const SpanDescription& span, bool wall_has_courses) {
  if (span.skewback) return *span.skewback > 0.0;
  return span.shape == IntradosShape::semicircular || !wall_has_courses;
}

Arch make_arch(const SpanDescription& span, bool wall_has_courses) {
  const Curve curve = intrados_of(span);
  const std::vector<Ring> rings = rings_of(span);
  const RingEnd left = ring_end(span, curve, true, wall_has_courses);
  const RingEnd right = ring_end(span, curve, false, wall_has_courses);
  Arch arch;
  add_stone(left, true, arch.blocks);
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const Ring* inner = r > 0 ? &rings[r - 1] : nullptr;
    const Ring* outer = r + 1 < rings.size() ? &rings[r + 1] : nullptr;
    const auto inner_bends = bends_between(curve, inner, &rings[r]);
    const auto outer_bends = bends_between(curve, &rings[r], outer);
    for (std::size_t j = 0; j + 1 < rings[r].joints.size(); ++j) {
      arch.blocks.push_back(voussoir_between(curve, rings[r], static_cast<int>(r), rings[r].joints[j],
                                             rings[r].joints[j + 1], inner_bends, outer_bends));
      check_voussoir(arch.blocks.back(), j + 1);
    }
    const std::size_t laid = rings[r].joints.size() - 1;
    if (span.shape == IntradosShape::points) check_ring(std::span(arch.blocks).last(laid));
  }
  add_stone(right, false, arch.blocks);
  std::vector<Point> extrados;
  for (const CurvePlace& place : bends_between(curve, &rings.back(), nullptr))
    extrados.push_back(curve.point(place, rings.back().outside));
  arch.enclosed = enclosed_by(extrados, left, right);
  return arch;
}

}  // namespace voussoir
