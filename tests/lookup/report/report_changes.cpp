/// @file Reports of readings that are differences. Oracle: the values that were put in.

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "lookup/report/report.h"
#include "lookup/report/report_profiles.h"
#include "tests/lookup/synthetic_library.h"

using namespace voussoir;
using Catch::Matchers::Contains;

namespace {

const test::SyntheticLibrary& synthetic() {
  static const test::SyntheticLibrary library(3, 6);
  return library;
}

constexpr std::size_t kTruth = 8;  // a single

/// Two epochs of every control point: 2 mm before, and what the scene changes without error.
Comparison two_epochs() {
  const test::SyntheticLibrary& library = synthetic();
  Comparison comparison = absolute_readings(library.library(), as_measurements(library.table.row(kTruth)));
  comparison.kind = ReadingKind::change;
  comparison.history = kLostState;
  for (std::size_t i = 0; i < library.points.size(); ++i) {
    comparison.before.push_back(2e-3);
    comparison.after.push_back(2e-3 + library.table.row(kTruth)[i] - library.intact()[i]);
  }
  return comparison;
}

LookupSettings stated_noise() {
  LookupSettings settings;
  settings.noise.shape = NoiseShape::gaussian;
  settings.noise.relative = 0.0;
  settings.noise.floor = 2e-5;
  return settings;
}

double change_at(std::size_t point) {
  return synthetic().table.row(kTruth)[point] - synthetic().intact()[point];
}

}  // namespace

TEST_CASE("JSON has before, after and change of every sensor, the history and the verdict") {
  const Comparison comparison = two_epochs();
  const Answer answer = locate_damage(comparison, stated_noise());
  const auto json = nlohmann::json::parse(json_report(answer, stated_noise(), comparison, {}));
  CHECK(json.at("history") == "lost");
  CHECK(json.at("known_bridge") == true);
  CHECK(json.at("measurements").at("kind") == "change");
  CHECK(json.at("verdict") == "located");
  CHECK(json.at("intact_probability").get<double>() == answer.posterior->missing_probability.front());
  REQUIRE(json.at("sensors").size() == synthetic().points.size());
  for (std::size_t i = 0; i < synthetic().points.size(); ++i) {
    const auto& sensor = json.at("sensors").at(i);
    CHECK(sensor.at("before_m") == 2e-3);
    CHECK(sensor.at("after_m").get<double>() == Approx(2e-3 + change_at(i)).epsilon(1e-12));
    CHECK(sensor.at("reading_m").get<double>() == Approx(change_at(i)).margin(1e-15));
    CHECK(sensor.at("predicted_m").get<double>() == Approx(change_at(i)).margin(1e-15));
  }
}

TEST_CASE("Without probabilities there is no verdict") {
  LookupSettings paper;
  paper.objective = Objective::paper;
  const Comparison comparison = two_epochs();
  const auto json =
      nlohmann::json::parse(json_report(locate_damage(comparison, paper), paper, comparison, {}));
  CHECK(json.at("verdict").is_null());
  CHECK(json.at("intact_probability").is_null());
}

TEST_CASE("The text says the history, the verdict and what moved most, before and after") {
  const Comparison comparison = two_epochs();
  const std::string text = text_report(locate_damage(comparison, stated_noise()), comparison, {});
  CHECK_THAT(text,
             Contains("History:      lost (missing blocks went while the bridge carried its weight)") &&
                 Contains("Verdict:      located (at least 90 % sure that each block named is missing)"));
  std::size_t most = 0;
  for (std::size_t i = 1; i < synthetic().points.size(); ++i)
    if (std::abs(change_at(i)) > std::abs(change_at(most))) most = i;
  const std::string change = fmt::format("{:.3f}", 1e3 * change_at(most));
  CHECK_THAT(text, Contains(fmt::format("      {:<20}      2.000 {:>11}  {:>9}  {:>9}\n",
                                        synthetic().points[most].name,
                                        fmt::format("{:.3f}", 2.0 + 1e3 * change_at(most)), change, change)));
  CHECK_THAT(text, !Contains("settlement"));
}

TEST_CASE("Figures of changes show the change, on an axis that says so, with both epochs in the table") {
  const Comparison comparison = two_epochs();
  const Answer answer = locate_damage(comparison, stated_noise());
  const std::vector<Figure> figures = profile_figures(PicturedAnswer(answer, comparison));
  REQUIRE(figures.size() == 1);  // this bridge has no arch
  CHECK_THAT(figures[0].pictures, Contains("change of vertical displacement [mm]"));
  const Table& table = figures[0].table;
  CHECK(table.columns[2] == "before [mm]");
  CHECK(table.columns[4] == "change [mm]");
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    CHECK(std::get<double>(table.rows[i][2]) == Approx(2.0));
    CHECK(std::get<double>(table.rows[i][4]) == Approx(1e3 * change_at(i)).margin(1e-12));
  }
  const std::string page = page_report(answer, stated_noise(), comparison, {});
  CHECK_THAT(
      page,
      Contains("(change between two times, the bridge at the first taken to be as the database has it)") &&
          !Contains("settlement"));
}

TEST_CASE("Sensors of one quantity under one load share a figure") {
  Comparison comparison = two_epochs();
  const std::size_t points = synthetic().points.size();
  comparison.kind = ReadingKind::load;
  comparison.before.clear();
  comparison.after.clear();
  comparison.quantity.assign(points, Quantity::uy);
  comparison.quantity[0] = comparison.quantity[1] = Quantity::tilt;
  comparison.load.assign(points, "axle");
  comparison.load[2] = "truck@2";
  const Answer answer = locate_damage(comparison, stated_noise());
  const std::vector<Figure> figures = profile_figures(PicturedAnswer(answer, comparison));
  REQUIRE(figures.size() == 3);
  CHECK(figures[0].id == "profile-top");
  CHECK(figures[1].id == "profile-tilt");
  CHECK(figures[2].id == "profile-top-2");
  CHECK(figures[0].table.rows.size() == points - 3);
  CHECK(figures[1].table.rows.size() == 2);
  CHECK_THAT(figures[1].pictures, Contains("added by the load: tilt [mm per m]"));
  CHECK(residual_figures(PicturedAnswer(answer, comparison))[1].table.columns[1] == "residual [mm per m]");
}

TEST_CASE("Where sensors are not judged no limit is drawn, and none is said to agree (fewer_readings.h)") {
  const Comparison comparison = two_epochs();
  Answer answer = locate_damage(comparison, stated_noise());
  for (SensorResidual& sensor : answer.residuals) sensor.error = sensor.point % 2 == 0 ? 1.0 : -1.0;
  const auto words = [&] {
    const Figure figure = residual_figures(PicturedAnswer(answer, comparison)).front();
    return std::pair(std::get<std::string>(figure.table.rows.front().back()),
                     figure.caption.find("dashed lines") != std::string::npos);
  };
  CHECK(words() == std::pair(std::string("agrees"), true));
  answer.without = AnswerWithout{{1}, nullptr};
  CHECK(words() == std::pair(std::string("not judged"), false));
}
