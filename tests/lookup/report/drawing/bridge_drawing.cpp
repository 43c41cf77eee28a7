#include "lookup/report/drawing/bridge_drawing.h"

#include <catch2/catch.hpp>
#include <regex>

#include "lookup/report/drawing/colour_map.h"

using namespace voussoir;

TEST_CASE("The colour bar has one rectangle for each level and none beyond, side by side and centred") {
  // Oracle: the levels counted; symmetry about the middle of the frame.
  const double width = 800.0;  // rectangles of 20 units: their text, to a tenth, is exact
  const std::string bar = colour_bar({"a title", percent_marks()}, width, 600.0);
  const std::regex rectangle("<rect class=\"m([0-9]+)\" x=\"([0-9.]+)\" y=\"[0-9.]+\" width=\"([0-9.]+)\"");
  double first = 0.0, end = 0.0;
  int level = 0;
  for (std::sregex_iterator found(bar.begin(), bar.end(), rectangle), none; found != none; ++found, ++level) {
    CHECK(std::stoi((*found)[1]) == level);
    const double left = std::stod((*found)[2]);
    if (level == 0) first = end = left;
    CHECK(left == Approx(end));
    end = left + std::stod((*found)[3]);
  }
  CHECK(level == kColourLevels);
  CHECK(end > first);
  CHECK(first + end == Approx(width));
}
