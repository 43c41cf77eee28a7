/// @file Keys of spans and walls. Oracle: what docs/shapes.md says of them.

#include "core/bridge_file/spans_section.h"

#include <catch2/catch.hpp>

#include "core/bridge_file/bridge_file.h"
#include "core/error.h"
#include "core/structure/arch.h"
#include "core/structure/model.h"
#include "tests/support/bridges.h"
#include "tests/support/refusal.h"

using namespace voussoir;
using Catch::Matchers::Contains;

namespace {

SpanDescription span(const std::string& keys) {
  return parse_bridge_file("[[spans]]\n" + keys, "s.toml").description.spans.front();
}

std::string span_message(const std::string& text) {
  return test::refusal_of([&] { make_model(parse_bridge_file(text, "s.toml").description); });
}

}  // namespace

TEST_CASE("Three changed lines make the reference bridge segmental", "[shapes]") {
  std::string text = reference_bridge_file().text;
  const auto change = [&](const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    text.replace(at, text.find('\n', at) - at, to);
  };
  change("centre_y_m = 1.05", "shape = \"segmental\"");
  change("intrados_radius_m = 3.5", "span_m = 7.0");
  change("ring_thickness_m = 0.5", "ring_thickness_m = 0.5\nrise_m = 2.0");
  const Model bridge = make_model(parse_bridge_file(text, "segmental.toml").description);
  CHECK(bridge.symmetry.has_value());
  CHECK(bridge.layout.count_with(BlockRole::ring) == 17);
  CHECK(bridge.layout.blocks[8].polygon[1].y() < 1.05 + 2.0);
  CHECK(bridge.layout.blocks[8].polygon[1].y() > 1.05 + 1.95);
}

TEST_CASE("Keys of a span mean what they say", "[shapes]") {
  const SpanDescription segment =
      span("shape = \"segmental\"\nspan_m = 5\nrise_m = 1.5\nspringing_m = 2\nskewback_m = 0.3");
  CHECK(segment.shape == IntradosShape::segmental);
  CHECK(segment.span == 5.0);
  CHECK(segment.rise == 1.5);
  CHECK(segment.centre_y == 2.0);
  CHECK(segment.skewback == 0.3);
  CHECK(span("shape = \"pointed\"\nspan_m = 5\nrise_m = 3").arc_radius == Approx(1.25 + 9.0 / 5.0));
  CHECK(span("shape = \"pointed\"\nspan_m = 5\nrise_m = 2\narc_radius_m = 4").arc_radius == 4.0);
  CHECK(span("shape = \"three-centred\"\nspan_m = 5\nrise_m = 2\nhaunch_radius_m = 1").arc_radius == 1.0);
  CHECK(span("shape = \"elliptic\"\nspan_m = 5\nrise_m = 2").shape == IntradosShape::elliptic);
  CHECK(span("shape = \"points\"\npoints_m = [[7, 1], [9, 2], [11, 1]]").points.size() == 3);
  const SpanDescription rings = span(
      "rings = [{thickness_m = 0.2, voussoirs = 31}, {thickness_m = 0.25, voussoirs = 33, staggered = "
      "true}]");
  CHECK(rings.ring_thickness == 0.2);
  CHECK(rings.voussoirs == 31);
  REQUIRE(rings.outer_rings.size() == 1);
  CHECK(rings.outer_rings.front() == RingDescription{0.25, 33, true});
}

TEST_CASE("A length of voussoirs gives the odd number that comes nearest to it", "[shapes]") {
  // A semicircle of 3.5 m radius is 10.9956 m long.
  CHECK(span("voussoir_length_m = 0.65").voussoirs == 17);
  CHECK(span("voussoir_length_m = 0.7").voussoirs == 15);
  CHECK(span("voussoir_length_m = 100").voussoirs == 3);
}

TEST_CASE("Bad spans are refused with file, line, value and what was expected", "[shapes]") {
  const std::string segment = "[[spans]]\nshape = \"segmental\"\nspan_m = 5\n";
  CHECK_THAT(span_message(segment), Contains("s.toml:1:") && Contains("rise_m") && Contains("is missing"));
  CHECK_THAT(span_message(segment + "rise_m = 3\n"),
             Contains("s.toml:4:") && Contains("is 3: expected at most half the span, 2.5"));
  CHECK_THAT(span_message(segment + "rise_m = 0.001\n"), Contains("s.toml:4:") && Contains("thousandth"));
  CHECK_THAT(span_message(segment + "rise_m = 1\nintrados_radius_m = 2\n"),
             Contains("s.toml:5:") && Contains("belongs to"));
  CHECK_THAT(span_message("[[spans]]\nspan_m = 5\n"),
             Contains("s.toml:2:") && Contains("belongs to segmental"));
  CHECK_THAT(span_message("[[spans]]\nshape = \"round\"\n"),
             Contains("s.toml:2:") && Contains("\"three-centred\""));
  CHECK_THAT(span_message("[[spans]]\nshape = \"pointed\"\nspan_m = 6\nrise_m = 2\n"),
             Contains("s.toml:4:") && Contains("do not meet in a point") && Contains("arc_radius_m"));
  CHECK_THAT(span_message("[[spans]]\nshape = \"three-centred\"\nspan_m = 6\nrise_m = 3\n"),
             Contains("less than half the span, 3"));
  CHECK_THAT(span_message("[[spans]]\nshape = \"points\"\npoints_m = [[7, 1], [9, 2]]\n"),
             Contains("s.toml:3:") && Contains("3 to 1000 points"));
  CHECK_THAT(span_message("[[spans]]\nshape = \"points\"\npoints_m = [[7, 1], [9, 2], [5, 1]]\n"),
             Contains("left springing to the right"));
  CHECK_THAT(span_message("[[spans]]\nshape = \"points\"\npoints_m = [[7, 1], [9, nan], [11, 1]]\n"),
             Contains("point 2"));
  CHECK_THAT(span_message("[[spans]]\nvoussoirs = 9\nrings = [{thickness_m = 0.2}]\n"),
             Contains("s.toml:2:") && Contains("in each of the rings"));
  CHECK_THAT(span_message("[[spans]]\nvoussoirs = 9\nvoussoir_length_m = 1\n"),
             Contains("s.toml:3:") && Contains("not both"));
  CHECK_THAT(span_message("[[spans]]\nrings = []\n"), Contains("1 to 20 rings"));
  CHECK_THAT(span_message("[[walls]]\nrole = \"pier\"\ncourses = 3\n"),
             Contains("s.toml:1:") && Contains("length_m") && Contains("is missing"));
  CHECK_THAT(span_message("[[walls]]\nrole = \"ring\"\nlength_m = 1\ncourses = 3\n"),
             Contains("laid by [[spans]]"));
  const std::string unknown = span_message("[[walls]]\nrole = \"roof\"\nlength_m = 1\ncourses = 3\n");
  CHECK_THAT(unknown, Contains("expected one of \"wall\", \"pier\"") && !Contains("ring"));
  CHECK_THAT(span_message("[[walls]]\nbase_y_m = 5\nlength_m = 1\ncourses = 3\n"), Contains("overlap"));
  CHECK_THAT(span_message("[[walls]]\nbase_y_m = 6\nfrom_x_m = 19.5\nlength_m = 1\ncourses = 3\n"),
             Contains("20.5"));
}

TEST_CASE("Parts are laid where they stand, their courses counted on, and the parapet is the top",
          "[shapes]") {
  const Model bridge = make_model(
      parse_bridge_file("[[walls]]\nrole = \"parapet\"\nbase_y_m = 6\nlength_m = 20\ncourses = 2\n", "p.toml")
          .description);
  CHECK(bridge.layout.count_with(BlockRole::parapet) == 41);
  CHECK(bridge.layout.last_position(13) == 21);
  CHECK(bridge.layout.last_position(14) == 20);
  for (const Block& block : bridge.layout.blocks) CHECK(block.top_course == (block.index.course == 14));
  CHECK(bridge.symmetry.has_value());
}
