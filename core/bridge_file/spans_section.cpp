#include "core/bridge_file/spans_section.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/arc_chain.h"
#include "core/structure/arch.h"

namespace voussoir {
namespace {

constexpr int kFewestVoussoirs = 3;
constexpr int kMostVoussoirs = 1000;
constexpr std::size_t kMostRings = 20;
constexpr std::size_t kFewestPoints = 3;
constexpr std::size_t kMostPoints = 1000;

bool needs_rise(IntradosShape shape) {
  return shape != IntradosShape::semicircular && shape != IntradosShape::points;
}

/// The keys of the curve, each with the shapes that have it.
void refuse_keys_of_other_shapes(TomlSection& section, IntradosShape shape) {
  const bool circle = shape == IntradosShape::semicircular;
  const bool surveyed = shape == IntradosShape::points;
  const auto only = [&](const char* key, bool belongs, const char* whose) {
    section.know(key);
    if (!belongs && section.has(key)) section.refuse(key, fmt::format("belongs to {}", whose));
  };
  only("intrados_radius_m", circle, "shape = \"semicircular\"; others have span_m and rise_m");
  only("centre_y_m", circle, "shape = \"semicircular\"; others have springing_m");
  only("centre_x_m", !surveyed, "other shapes; points_m says where the intrados lies");
  only("springing_m", !surveyed && !circle, "shapes with span_m; a semicircle has centre_y_m");
  only("span_m", needs_rise(shape), "segmental, pointed, three-centred and elliptic shapes");
  only("rise_m", needs_rise(shape), "segmental, pointed, three-centred and elliptic shapes");
  only("arc_radius_m", shape == IntradosShape::pointed, "shape = \"pointed\"");
  only("haunch_radius_m", shape == IntradosShape::three_centred, "shape = \"three-centred\"");
  only("points_m", surveyed, "shape = \"points\"");
}

void check_rise(const TomlSection& section, const SpanDescription& span) {
  const double half = 0.5 * span.span;
  const bool flat = span.shape == IntradosShape::segmental || span.shape == IntradosShape::three_centred;
  const bool full_allowed = span.shape == IntradosShape::segmental;
  if (flat && (span.rise > half || (span.rise == half && !full_allowed)))
    section.refuse("rise_m", fmt::format("is {:g}: expected {} half the span, {:g}", span.rise,
                                         full_allowed ? "at most" : "less than", half));
  if (span.rise < 1e-3 * span.span)
    section.refuse("rise_m", fmt::format("is {:g}: expected at least a thousandth of the span, {:g}",
                                         span.rise, span.span));
}

void read_arc_radius(TomlSection& section, SpanDescription& span) {
  if (span.shape == IntradosShape::pointed) {
    span.arc_radius = pointed_radius(span.span, span.rise);
    section.length("arc_radius_m", span.arc_radius);
    if (!is_pointed(span.span, span.rise, span.arc_radius))
      section.refuse(section.has("arc_radius_m") ? "arc_radius_m" : "rise_m",
                     fmt::format("two arcs of {:g} m do not meet in a point {:g} m above a span of {:g} m: "
                                 "expected a rise above half the span, or a larger arc_radius_m",
                                 span.arc_radius, span.rise, span.span));
  }
  if (span.shape == IntradosShape::three_centred) {
    span.arc_radius = roundest_haunch_radius(span.span, span.rise);
    section.positive("haunch_radius_m", span.arc_radius, kLargestLength);
    if (span.arc_radius > 0.999 * span.rise)
      section.refuse("haunch_radius_m",
                     fmt::format("is {:g}: expected less than the rise, {:g}", span.arc_radius, span.rise));
  }
}

void read_points(TomlSection& section, SpanDescription& span) {
  section.require("points_m");
  span.points = section.points("points_m", kFewestPoints, kMostPoints);
  for (std::size_t i = 0; i + 1 < span.points.size(); ++i)
    if ((span.points[i + 1] - span.points[i]).norm() < kSmallestLength)
      section.refuse("points_m", fmt::format("points {} and {} are closer than {:g} m: expected points along "
                                             "the intrados from the left springing to the right one",
                                             i + 1, i + 2, kSmallestLength));
  if (span.points.front().x() >= span.points.back().x())
    section.refuse("points_m", "expected points from the left springing to the right one");
  if (self_crossing(span.points) || area(span.points) >= 0.0)
    section.refuse("points_m",
                   "the points' line crosses itself, or sags below its springings: expected points in their "
                   "order along the intrados, from the left springing over the crown to the right one");
  for (const Point& point : span.points)
    if (point.y() < 0.0) section.refuse("points_m", fmt::format("y is {:g}: expected 0 or more", point.y()));
  const auto& first = span.points.front();
  const auto& last = span.points.back();
  span.centre_x = 0.5 * (first.x() + last.x());
  span.centre_y = std::min(first.y(), last.y());
  span.span = last.x() - first.x();
}

/// The odd number of voussoirs, so that there is a keystone, that comes nearest to a length.
int number_by_length(double whole, double length) {
  const double half = std::round(0.5 * (whole / length - 1.0));
  return static_cast<int>(std::clamp(2.0 * half + 1.0, double{kFewestVoussoirs}, double{kMostVoussoirs - 1}));
}

void read_voussoirs(TomlSection& section, double intrados_length, int& voussoirs, bool& staggered) {
  section.count("voussoirs", voussoirs, kFewestVoussoirs, kMostVoussoirs);
  double length = 0.0;
  section.length("voussoir_length_m", length);
  if (length > 0.0) {
    if (section.has("voussoirs")) section.refuse("voussoir_length_m", "expected it or voussoirs, not both");
    voussoirs = number_by_length(intrados_length, length);
  }
  section.flag("staggered", staggered);
}

/// rings = [{thickness_m, voussoirs, ..}, ..] from the intrados outwards.
void read_rings(TomlSection& section, double intrados_length, SpanDescription& span) {
  const toml::array* rings = section.tables("rings", "rings = [{thickness_m = 0.23, voussoirs = 31}, ..]");
  if (rings == nullptr) {
    section.length("ring_thickness_m", span.ring_thickness);
    read_voussoirs(section, intrados_length, span.voussoirs, span.staggered);
    return;
  }
  for (const char* key : {"ring_thickness_m", "voussoirs", "voussoir_length_m", "staggered"}) {
    section.know(key);
    if (section.has(key)) section.refuse(key, "expected in each of the rings");
  }
  if (rings->empty() || rings->size() > kMostRings)
    section.refuse("rings", fmt::format("has {}: expected 1 to {} rings", rings->size(), kMostRings));
  std::vector<RingDescription> read;
  for (const toml::node& node : *rings) {
    TomlSection table(section.file(), node.as_table(), " in rings");
    RingDescription& ring = read.emplace_back();
    table.length("thickness_m", ring.thickness);
    read_voussoirs(table, intrados_length, ring.voussoirs, ring.staggered);
    table.refuse_unknown_keys();
  }
  span.ring_thickness = read.front().thickness;
  span.voussoirs = read.front().voussoirs;
  span.staggered = read.front().staggered;
  span.outer_rings.assign(read.begin() + 1, read.end());
}

}  // namespace

SpanDescription read_span(TomlSection section) {
  SpanDescription span;
  section.choice("shape", span.shape,
                 {{"semicircular", IntradosShape::semicircular},
                  {"segmental", IntradosShape::segmental},
                  {"pointed", IntradosShape::pointed},
                  {"three-centred", IntradosShape::three_centred},
                  {"elliptic", IntradosShape::elliptic},
                  {"points", IntradosShape::points}});
  refuse_keys_of_other_shapes(section, span.shape);
  section.number("centre_x_m", span.centre_x, -kLargestLength, kLargestLength);
  section.number("centre_y_m", span.centre_y, 0.0, kLargestLength);
  section.number("springing_m", span.centre_y, 0.0, kLargestLength);
  section.length("intrados_radius_m", span.intrados_radius);
  if (needs_rise(span.shape)) {
    section.require("span_m");
    section.require("rise_m");
    section.length("span_m", span.span);
    section.length("rise_m", span.rise);
    check_rise(section, span);
    read_arc_radius(section, span);
  }
  if (span.shape == IntradosShape::points) read_points(section, span);
  read_rings(section, intrados_of(span).length, span);
  double skewback = 0.0;
  section.number("skewback_m", skewback, 0.0, kLargestLength);
  if (section.has("skewback_m")) span.skewback = skewback;
  section.refuse_unknown_keys();
  return span;
}

}  // namespace voussoir
