/// Pictures and tables: colours, axes, charts, escaping.

#include <fmt/format.h>

#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "lookup/report/drawing/bridge_drawing.h"
#include "lookup/report/drawing/chart.h"
#include "lookup/report/drawing/colour_map.h"
#include "lookup/report/drawing/page.h"

using namespace voussoir;
using Catch::Matchers::Contains;

namespace {

/// Lightness L* of CIELAB for sRGB (IEC 61966-2-1, CIE 15).
double lightness(Colour colour) {
  const auto linear = [](std::uint8_t byte) {
    const double c = byte / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  const double y = 0.2126 * linear(colour.red) + 0.7152 * linear(colour.green) + 0.0722 * linear(colour.blue);
  return y > 0.008856 ? 116.0 * std::cbrt(y) - 16.0 : 903.3 * y;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

}  // namespace

TEST_CASE("Levels of the colour map step evenly in CIELAB's lightness, away from the page") {
  const double step =
      (lightness(dark_colour(kColourLevels - 1)) - lightness(dark_colour(0))) / (kColourLevels - 1);
  CHECK(step > 3.5);  // some 80 of 100 over all levels
  for (int level = 1; level < kColourLevels; ++level) {
    INFO("level " << level);
    CHECK(lightness(dark_colour(level)) - lightness(dark_colour(level - 1)) == Approx(step).epsilon(0.35));
    CHECK(lightness(light_colour(level)) < lightness(light_colour(level - 1)));
  }
  CHECK(colour_level(-1.0) == 0);
  CHECK(colour_level(0.5) == kColourLevels / 2);
  CHECK(colour_level(1.0) == kColourLevels - 1);
}

TEST_CASE("Axes cover their values and have round ticks") {
  const std::array<double, 4> values = {-0.37, 8.2, 3.0, std::nan("")};
  const AxisMap axis = axis_over(values, AxisScale::linear, 6, 100.0, 400.0);
  CHECK(axis.lowest == Approx(-2.0));
  CHECK(axis.highest == Approx(10.0));
  CHECK(axis(axis.lowest) == Approx(100.0));
  CHECK(axis(4.0) == Approx(250.0));
  std::string ticks;
  for (const Tick& tick : ticks_of(axis, 6)) ticks += tick.text + " ";
  CHECK(ticks == "-2 0 2 4 6 8 10 ");
  const std::array<double, 3> wide = {0.003, 70.0, 0.0};
  const AxisMap decades = axis_over(wide, AxisScale::logarithmic, 6, 0.0, 5.0);
  CHECK(decades(1.0) == Approx(3.0));  // three decades above 0.001, of five
  CHECK(ticks_of(decades, 6).size() == 6);
  const std::array<double, 1> single = {5.0};
  const AxisMap about_five = axis_over(single, AxisScale::linear, 4, 0.0, 1.0);
  CHECK((about_five.lowest < 5.0 && about_five.highest > 5.0));
}

TEST_CASE("A chart's discs lie where the axes say, and what has no value is not drawn") {
  Chart chart{"test", {"x", AxisScale::linear, {{0.0, 10.0}}}, {"y", AxisScale::linear, {{0.0, 1.0}}}, {}};
  chart.series = {{"a <b>", 1, Mark::points, {0.0, 10.0, 5.0}, {0.0, 1.0, std::nan("")}},
                  {"line", 2, Mark::line, {1.0, 2.0, 3.0, 4.0, 5.0}, {0.1, 0.2, std::nan(""), 0.4, 0.5}}};
  chart.series.push_back(
      {"band", 3, Mark::band, {1.0, 2.0, 3.0, 4.0}, {0.0, 0.1, std::nan(""), 0.3}, {0.5, 0.6, 0.7, 0.8}});
  const Drawing drawing = draw(chart);
  CHECK(count(drawing.elements, "<circle") == 2);
  CHECK_THAT(drawing.elements, Contains("cx=\"62.0\" cy=\"254.0\""));  // the corner of the axes
  CHECK_THAT(drawing.elements, Contains("cx=\"466.0\" cy=\"10.0\""));  // the opposite corner
  const std::size_t line = drawing.elements.find("class=\"line s2\"");
  REQUIRE(line != std::string::npos);
  CHECK(count(drawing.elements.substr(line), "M") == 2);  // interrupted once
  const std::size_t band = drawing.elements.find("class=\"band f3\"");
  REQUIRE(band != std::string::npos);
  CHECK(count(drawing.elements.substr(band, drawing.elements.find("/>", band) - band), "Z") ==
        2);  // in two parts
  CHECK_THAT(svg_file(draw_with_legend(chart)), Contains("a &lt;b&gt;") && !Contains("<b>"));
}

TEST_CASE("A value without neighbours is a tick, not an invisible line, and hollow marks need no value") {
  Chart chart{"test", {"x", AxisScale::linear, {{0.0, 10.0}}}, {"y", AxisScale::linear, {{0.0, 1.0}}}, {}};
  chart.series = {{"line", 2, Mark::line, {5.0}, {0.5}},
                  {"ticks", 1, Mark::ticks, {2.0, 8.0}, {0.5, 0.5}},
                  {"none", 0, Mark::hollow, {5.0}, {std::nan("")}}};
  const Drawing drawing = draw(chart);
  // The middle of the axes, 16 units wide: from 62 to 466, and from 254 to 10.
  CHECK_THAT(drawing.elements, Contains("class=\"line s2\" d=\"M256.0 132.0h16\""));
  CHECK_THAT(drawing.elements, Contains("class=\"line s1\" d=\"M134.8 132.0h16M377.2 132.0h16\""));
  CHECK_THAT(drawing.elements, Contains("class=\"silent\" cx=\"264.0\" cy=\"254.0\""));
}

TEST_CASE("An axis of names has all names that have room, and none on the frame") {
  const ChartAxis few = named_axis("sensor", {"TILT-NW1", "TILT-NW2"});
  REQUIRE(few.ticks.size() == 2);
  CHECK(few.ticks[1].text == "TILT-NW2");
  CHECK(few.range->first < few.ticks.front().value);
  CHECK(few.range->second > few.ticks.back().value);
  std::vector<std::string> names;
  for (int i = 1; i <= 100; ++i) names.push_back(i == 1 ? "" : fmt::format("T{}", i));
  const ChartAxis many = named_axis("sensor", names);
  CHECK(many.ticks.front().text == "T2");  // the first place is free
  CHECK(many.ticks.size() > 5);
  for (std::size_t i = 1; i < many.ticks.size(); ++i)  // 404 units hold a hundred places
    CHECK(4.04 * (many.ticks[i].value - many.ticks[i - 1].value) > 7.0 * 4.0);
}

TEST_CASE("Marks beside a bar of colours are round, whichever way it grows") {
  std::string texts;
  for (const BarMark& mark : round_marks(0.231, -4.84)) {
    texts += mark.text + " ";
    CHECK(mark.share == Approx((0.231 - std::stod(mark.text)) / (0.231 + 4.84)).margin(1e-12));
  }
  CHECK(texts == "-4 -3 -2 -1 0 ");
  CHECK(round_marks(2.0, 2.0).size() == 1);
}

TEST_CASE("Columns with decimals are fixed on pages, zero without a sign, and whole in CSV") {
  const Table table{{"point", "mm"}, {{"T1", 1.23456e-5}, {"T2", -1e-9}, {"T3", -1.5}}, {kAsNeeded, 3}};
  CHECK_THAT(to_html(table), Contains(">0.000<") && Contains(">\u22121.500<") && !Contains("e\u2212") &&
                                 !Contains(">\u22120.000<"));
  CHECK_THAT(to_csv(table), Contains("1.23456e-05"));
}

TEST_CASE("Tables keep all digits and quote as RFC 4180 says in CSV, and escape in HTML") {
  const Table table{{"scene", "p"}, {{"10,4 \"x\" <y>", 0.1}, {"intact", std::nan("")}, {"5", 1.0 / 3.0}}};
  CHECK(to_csv(table) == "scene,p\n\"10,4 \"\"x\"\" <y>\",0.1\nintact,\n5,0.3333333333333333\n");
  const std::string html = to_html(table, 3);
  CHECK_THAT(html, Contains("<td>10,4 &quot;x&quot; &lt;y&gt;</td><td class=\"number\">0.1</td>"));
  CHECK_THAT(html, Contains(">0.333<"));
}

TEST_CASE("A page forbids to fetch anything") {
  const std::string page = html_page("A & B", paragraph("x < y"));
  CHECK_THAT(page, Contains("default-src 'none'") && Contains("A &amp; B") && Contains("x &lt; y"));
  CHECK(count(page, "http://") + count(page, "https://") == 0);
}
