/// @file Pictures and tables of an answer. Oracle: what was put into the answer.

#include "lookup/report/report_pictures.h"

#include <catch2/catch.hpp>

#include "lookup/report/report.h"
#include "lookup/report/report_profiles.h"
#include "tests/lookup/synthetic_library.h"

using namespace voussoir;
using Catch::Matchers::Contains;

namespace {

int times_in(const std::string& text, const std::string& piece) {
  int found = 0;
  for (std::size_t at = text.find(piece); at != std::string::npos; at = text.find(piece, at + 1)) ++found;
  return found;
}

constexpr std::size_t kSingles = 24;

/// An answer to readings of a scene, without error, of a wall of four courses of six blocks.
struct AskedWall {
  test::SyntheticLibrary synthetic{4, 6};
  Comparison comparison;
  LookupSettings settings;
  Answer answer;

  explicit AskedWall(std::size_t row)
      : comparison(absolute_readings(synthetic.library(), as_measurements(synthetic.table.row(row)))) {
    settings.noise.shape = NoiseShape::gaussian;
    settings.noise.relative = 0.0;
    settings.noise.floor = 1e-5;
    answer = locate_damage(comparison, settings);
  }
  PicturedAnswer report() const { return {answer, comparison}; }
  std::string page() const { return page_report(answer, settings, comparison, {}); }
};

}  // namespace

TEST_CASE("Blocks whose loss is not excluded are striped, and the table has all of them") {
  AskedWall asked(0);
  REQUIRE(asked.page().find("class=\"verdict intact\"") != std::string::npos);
  asked.answer.posterior->open_losses.clear();
  const Figure none = bridge_figure(asked.report());
  CHECK(times_in(none.pictures, "striped") == 0);
  CHECK_THAT(none.caption,
             !Contains("Striped") && !Contains("Outlined") && !Contains("hollow") && !Contains("orange"));
  for (std::size_t row = 1; row <= kSingles; ++row) asked.answer.posterior->open_losses.push_back({row, 0.5});
  const Figure open = bridge_figure(asked.report());
  CHECK(times_in(open.pictures, "<path class=\"striped\"") == static_cast<int>(kSingles));
  CHECK(times_in(open.pictures, "<rect class=\"striped\"") == 1);  // the key
  CHECK_THAT(open.caption, Contains("Striped"));
  CHECK(open.table.rows.size() == kSingles);
  for (const auto& row : open.table.rows) CHECK_THAT(std::get<std::string>(row[3]), Contains("0.50 times"));
}

TEST_CASE("The verdict's bar has a class for each verdict") {
  AskedWall asked(8);
  CHECK_THAT(asked.page(), Contains("class=\"verdict located\""));
  asked.answer.contested = true;
  CHECK_THAT(asked.page(), Contains("class=\"verdict cannot-tell\""));
  asked.answer.fit->explained = false;
  CHECK_THAT(asked.page(), Contains("class=\"verdict unexplained\""));
}

TEST_CASE("A reading in one place with another stands beside it, and one that is far too long is cut") {
  AskedWall asked(0);
  asked.comparison.measured.displacement[5] = -50e-3;  // others are some two millimetres
  const std::string picture = bridge_figure(asked.report()).pictures;
  CHECK(times_in(picture, "m-4 -5l4 5l4 -5") == 1);
  CHECK_THAT(picture, Contains(">T6</text>"));
  std::vector<std::string> places;
  for (std::size_t at = picture.find(" cx=\""); at != std::string::npos; at = picture.find(" cx=\"", at + 1))
    places.push_back(picture.substr(at, picture.find(" r=", at) - at));
  CHECK(places.size() == asked.synthetic.points.size());
  std::ranges::sort(places);
  CHECK(std::ranges::adjacent_find(places) == places.end());
}

TEST_CASE("The band is what residuals are divided by, and residuals have one sign") {
  AskedWall asked(8);
  for (std::size_t point = 0; point < asked.comparison.measured.displacement.size(); ++point)
    asked.comparison.measured.displacement[point] += (point % 3 == 0 ? 1.0 : -0.4) * 1e-5;
  asked.answer = locate_damage(asked.comparison, asked.settings);
  const Table profile = profile_figures(asked.report()).front().table;
  const Table residuals = residual_figures(asked.report()).front().table;
  REQUIRE(profile.rows.size() == residuals.rows.size());
  for (std::size_t i = 0; i < profile.rows.size(); ++i) {
    const double off = std::get<double>(profile.rows[i][2]) - std::get<double>(profile.rows[i][3]);
    const double deviations = std::get<double>(residuals.rows[i][2]);
    CHECK(std::get<double>(residuals.rows[i][1]) == Approx(off).margin(1e-12));
    CHECK(2.0 * off / std::get<double>(profile.rows[i][4]) == Approx(deviations).margin(1e-9));
  }
}

TEST_CASE("A few sensors have ticks in the place of a line, and their names at the axis") {
  AskedWall asked(0);
  std::vector<double>& readings = asked.comparison.measured.displacement;
  for (std::size_t point = 2; point < readings.size(); ++point) readings[point] = std::nan("");
  asked.comparison.measured.silent[5] = 1;
  asked.answer = locate_damage(asked.comparison, asked.settings);
  const Figure figure = profile_figures(asked.report()).front();
  CHECK(figure.title == "Top, T1, T2, T6");
  for (const char* name : {">T1<", ">T2<", ">T6<"}) CHECK_THAT(figure.pictures, Contains(name));
  CHECK(times_in(figure.pictures, "class=\"silent\"") == 2);  // the mark and its key
  CHECK_THAT(figure.pictures, !Contains(">1.5<"));            // no fractional places
}
