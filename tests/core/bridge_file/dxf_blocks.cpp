/// @file Drawings of blocks. Oracle: files written here.

#include "core/bridge_file/dxf_blocks.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "tests/support/dxf_drawing.h"
#include "tests/support/refusal.h"

using namespace voussoir;
using Catch::Matchers::Contains;
using test::dxf_drawing, test::lwpolyline, test::kSquare;

namespace {

/// What a drawing is refused with.
std::string dxf(const std::string& text) {
  return test::refusal_of([&] { parse_dxf_blocks(text, "a.dxf"); });
}

}  // namespace

TEST_CASE("DXF: a byte order mark before the drawing does not matter", "[block-file]") {
  const std::string text = dxf_drawing(lwpolyline("wall", kSquare));
  CHECK(parse_dxf_blocks("\xEF\xBB\xBF" + text, "a.dxf").blocks.size() ==
        parse_dxf_blocks(text, "a.dxf").blocks.size());
}

TEST_CASE("DXF: layer, ring, label, unit and arcs (written out)", "[block-file]") {
  const BlockFile file = parse_dxf_blocks(
      dxf_drawing(lwpolyline("RING 2", kSquare) + "0\nTEXT\n8\nx\n10\n1\n20\n1\n1\nkeystone\n" +
                      lwpolyline("dims", kSquare) + lwpolyline("wall", kSquare, 0) +
                      "0\nPOLYLINE\n8\npier\n70\n1\n0\nVERTEX\n8\npier\n10\n4\n20\n0\n0\nVERTEX"
                      "\n8\npier\n10\n6\n20\n0\n42\n1\n0\nSEQEND\n",
                  "9\n$INSUNITS\n70\n5\n"),
      "a.dxf");
  REQUIRE(file.blocks.size() == 2);
  CHECK(file.blocks[0].role == BlockRole::ring);
  CHECK(file.blocks[0].ring == 1);
  CHECK(file.blocks[0].label == "keystone");
  CHECK(area(file.blocks[0].polygon) == Approx(4e-4));
  CHECK(file.blocks[1].role == BlockRole::pier);
  CHECK(file.blocks[1].label == "2");
  // Half a circle of 1 cm radius in 18 chords.
  CHECK(std::abs(area(file.blocks[1].polygon)) ==
        Approx(0.5 * 18 * 1e-4 * std::sin(std::numbers::pi / 18)).epsilon(1e-9));
  REQUIRE(file.notes.size() == 2);
  CHECK_THAT(file.notes[0], Contains("1 outlines on layer 'dims'"));
  CHECK_THAT(file.notes[1], Contains("1 outlines that are not closed"));
}

TEST_CASE("Bad drawings of blocks are refused with file, line and what was expected", "[block-file]") {
  CHECK_THAT(dxf("hello\n"), Contains("a.dxf:1:") && Contains("'hello'") && Contains("group code"));
  CHECK_THAT(dxf("AutoCAD Binary DXF\r\n"), Contains("a.dxf:1:"));
  CHECK_THAT(dxf("0\n"), Contains("a.dxf:1:") && Contains("ends after a group code"));
  CHECK_THAT(dxf(dxf_drawing("0\nLWPOLYLINE\n8\nwall\n10\nx\n")),
             Contains("'x'") && Contains("expected a number"));
  CHECK_THAT(dxf(dxf_drawing("0\nLWPOLYLINE\n8\nwall\n20\n1\n")), Contains("expected group 10"));
  CHECK_THAT(dxf(dxf_drawing("0\nVERTEX\n")), Contains("after a POLYLINE"));
  CHECK_THAT(dxf(dxf_drawing("", "9\n$INSUNITS\n70\n1\n")), Contains("$INSUNITS is 1"));
  CHECK_THAT(dxf(dxf_drawing(lwpolyline("dims", kSquare))), Contains("no closed polylines"));
}

TEST_CASE("A drawing that was cut off is refused with its line", "[block-file]") {
  const std::string whole = dxf_drawing(lwpolyline("wall", kSquare));
  CHECK_THAT(dxf(whole.substr(0, whole.find("0\nENDSEC", whole.find("ENTITIES")))),
             Contains("ends within the section ENTITIES") && Contains("expected ENDSEC"));
  CHECK_THAT(
      dxf(dxf_drawing("0\nLWPOLYLINE\n8\nwall\n90\n4\n70\n1\n10\n0\n20\n0\n10\n1\n20\n0\n10\n1\n20\n1\n")),
      Contains("a.dxf:12:") && Contains("has 3 vertices: expected the 4"));
}
