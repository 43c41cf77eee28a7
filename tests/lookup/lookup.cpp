/// @file The whole lookup on a made-up library: verdict, fit, odd sensors, groups, reports.

#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "lookup/readings/csv_text.h"
#include "lookup/report/report.h"
#include "lookup/report/words.h"
#include "lookup/search/misfit.h"
#include "tests/lookup/synthetic_library.h"

using namespace voussoir;
using voussoir::test::SyntheticLibrary;

namespace {

const Source kSource = {"m.csv", "bridge.h5", "made up", "0123456789abcdef0123456789abcdef", false};

/// A setting for each search.
std::vector<LookupSettings> each_search() {
  std::vector<LookupSettings> result(3);
  result[1].search = Search::genetic;
  result[2].search = Search::nearest;
  return result;
}

}  // namespace

TEST_CASE("Noise-free readings of every scene name that scene first, by both objectives") {
  const SyntheticLibrary library(4, 6);
  for (const Objective objective : {Objective::posterior, Objective::paper}) {
    LookupSettings settings;
    settings.objective = objective;
    settings.top = 1;
    for (std::size_t row = 0; row < library.table.rows; ++row) {
      const Measurements measured = as_measurements(library.table.row(row));
      const Answer answer = locate_damage(absolute_readings(library.library(), measured), settings);
      REQUIRE(answer.candidates.front().row == row);
      REQUIRE(answer.candidates.front().misfit == Approx(std::log(1e-16)));
    }
  }
}

TEST_CASE("Every search and objective names a clearly visible block and agrees on its misfit") {
  const SyntheticLibrary library(4, 9);
  Random random(1);
  const std::size_t truth = library.row_of({{BlockId{29}}});
  const Measurements measured = library.measure(truth, 0.003, NoiseShape::uniform, random);
  for (LookupSettings settings : each_search())
    for (const Objective objective : {Objective::posterior, Objective::paper}) {
      settings.objective = objective;
      settings.prior.missing = {0, 1};
      const Answer answer = locate_damage(absolute_readings(library.library(), measured), settings);
      CHECK(answer.candidates.front().row == truth);
      CHECK(answer.candidates.front().misfit == misfit(measured.displacement, library.table.row(truth)));
      CHECK(answer.candidates.front().posterior.has_value() == (objective == Objective::posterior));
    }
}

TEST_CASE("A scene is called most likely only if no other is likelier, whatever the search") {
  const SyntheticLibrary library(4, 9);
  Random random(12);
  int others = 0, likeliest = 0;
  for (int trial = 0; trial < 40; ++trial)
    for (LookupSettings settings : each_search()) {
      const Measurements measured =
          library.measure(library.row_of({{BlockId{29}}}), 0.02, NoiseShape::uniform, random);
      settings.top = 1;  // the misfit prefers pairs, of which many fit the noise
      const Answer answer = locate_damage(absolute_readings(library.library(), measured), settings);
      const auto& probability = answer.posterior->probability.values;
      const bool is_best =
          *answer.candidates.front().posterior == *std::max_element(probability.begin(), probability.end());
      (is_best ? likeliest : others) += 1;
      const std::string text = text_report(
          answer, absolute_readings(library.library(), no_measurements(library.points.size())), kSource);
      const std::string page =
          page_report(answer, settings, absolute_readings(library.library(), measured), kSource);
      const auto json = nlohmann::json::parse(
          json_report(answer, settings,
                      absolute_readings(library.library(), no_measurements(library.points.size())), kSource));
      for (const std::string& words : {text, page}) {
        const bool named = words.find("Most likely: ") != std::string::npos;
        const bool one_of_many = words.find("Likeliest of many: ") != std::string::npos;
        CHECK((named || one_of_many) == is_best);
        CHECK(!(named && one_of_many));
        CHECK((words.find("Nearest by misfit: ") != std::string::npos) == !is_best);
        CHECK((words.find("not found by this search: ") != std::string::npos) == !is_best);
      }
      const std::string verdict = json["verdict"];
      const bool names_none = verdict == "cannot-tell" || verdict == "damaged-unlocated";
      CHECK(json["first_candidate"] == (!is_best     ? "nearest by misfit"
                                        : names_none ? "likeliest of many"
                                                     : "most likely"));
    }
  CHECK(likeliest >= 40);
  CHECK(others >= 10);
}

TEST_CASE("A bridge that stands by what it has slid is called so wherever an answer is (written out)") {
  const SyntheticLibrary library(4, 9);
  Random random(12);
  const Measurements measured =
      library.measure(library.row_of({{BlockId{29}}}), 0.02, NoiseShape::uniform, random);
  const Comparison comparison = absolute_readings(library.library(), measured);
  const Answer answer = locate_damage(comparison, {});
  for (const bool slid : {false, true}) {
    Source source = kSource;
    source.stands_by_slip = slid;
    for (const std::string& words :
         {text_report(answer, comparison, source), page_report(answer, {}, comparison, source)})
      CHECK((words.find("stands intact only by what its joints have slid") != std::string::npos) == slid);
    CHECK(nlohmann::json::parse(json_report(answer, {}, comparison, source))["database"]["stands_by_slip"] ==
          slid);
  }
}

TEST_CASE("A single is not beaten by the many pairs that fit its noise as well") {
  const SyntheticLibrary library(4, 9);
  Random random(2);
  int right = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const Measurements measured =
        library.measure(library.row_of({{BlockId{29}}}), 0.01, NoiseShape::uniform, random);
    right += locate_damage(absolute_readings(library.library(), measured), {})
                         .candidates.front()
                         .scene.missing() == 1
                 ? 1
                 : 0;
  }
  CHECK(right >= 18);
}

TEST_CASE("Intact readings are hardly ever called damaged") {
  const SyntheticLibrary library(4, 9);
  Random random(3);
  int wrong = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const Measurements measured = library.measure(0, 0.05, NoiseShape::uniform, random);
    wrong += locate_damage(absolute_readings(library.library(), measured), {})
                     .candidates.front()
                     .scene.removed.empty()
                 ? 0
                 : 1;
  }
  CHECK(wrong <= 2);
}

TEST_CASE("A wild sensor is named and does not hide the damage") {
  const SyntheticLibrary library(4, 9);
  Random random(4);
  const std::size_t truth = library.row_of({{BlockId{20}}});
  Measurements measured = library.measure(truth, 0.003, NoiseShape::uniform, random);
  measured.displacement[14] *= 1.5;
  const Answer answer = locate_damage(absolute_readings(library.library(), measured), {});
  CHECK(answer.candidates.front().row == truth);
  std::vector<std::size_t> odd;
  for (const SensorResidual& sensor : answer.residuals)
    if (sensor.disagrees) odd.push_back(sensor.point);
  CHECK(odd == std::vector<std::size_t>{14});
  CHECK(text_report(answer, absolute_readings(library.library(), no_measurements(library.points.size())),
                    kSource)
            .find("Sensor T15 disagrees: it reads") != std::string::npos);
}

TEST_CASE(
    "Readings of no scene are called unexplained: beyond the bound, beyond the scatter, or with a pattern") {
  const SyntheticLibrary library(4, 9);
  Random random(5);
  Measurements bent = library.measure(0, 0.002, NoiseShape::uniform, random);
  for (std::size_t i = 0; i < bent.displacement.size(); ++i)
    bent.displacement[i] *= 1.0 + 0.1 * std::sin(0.5 * static_cast<double>(i) + 1.0);
  for (const NoiseShape shape :
       {NoiseShape::uniform, NoiseShape::gaussian, NoiseShape::laplace, NoiseShape::student}) {
    LookupSettings settings;
    settings.noise = {shape, 0.005};
    const Answer answer = locate_damage(absolute_readings(library.library(), bent), settings);
    INFO(to_string(shape));
    REQUIRE_FALSE(answer.candidates.empty());
    CHECK_FALSE(answer.fit->explained);
  }
  const Answer unknown_level = locate_damage(absolute_readings(library.library(), bent), {});
  CHECK_FALSE(unknown_level.fit->explained);
  CHECK(text_report(unknown_level,
                    absolute_readings(library.library(), no_measurements(library.points.size())), kSource)
            .find("No scene in this database is an answer to these measurements") != std::string::npos);
}

TEST_CASE("Readings with the stated noise are called explained, for every shape") {
  const SyntheticLibrary library(4, 9);
  Random random(6);
  for (int trial = 0; trial < 20; ++trial) {
    const Measurements uniform = library.measure(12, 0.05, NoiseShape::uniform, random);
    const Measurements gaussian = library.measure(12, 0.05, NoiseShape::gaussian, random);
    LookupSettings settings;
    CHECK(locate_damage(absolute_readings(library.library(), uniform), settings).fit->explained);
    settings.noise = {NoiseShape::uniform, 0.05};
    CHECK(locate_damage(absolute_readings(library.library(), uniform), settings).fit->explained);
    settings.noise.shape = NoiseShape::gaussian;
    CHECK(locate_damage(absolute_readings(library.library(), gaussian), settings).fit->explained);
    settings.noise.shape = NoiseShape::student;
    CHECK(locate_damage(absolute_readings(library.library(), gaussian), settings).fit->explained);
  }
}

TEST_CASE("Scenes that the sensors cannot tell apart are reported together") {
  SyntheticLibrary library(4, 9);
  const std::size_t a = library.row_of({{BlockId{5}}}), b = library.row_of({{BlockId{6}}});
  std::copy_n(library.vertical.begin() + static_cast<std::ptrdiff_t>(a * library.table.points),
              library.table.points,
              library.vertical.begin() + static_cast<std::ptrdiff_t>(b * library.table.points));
  Random random(7);
  const Answer answer = locate_damage(
      absolute_readings(library.library(), library.measure(a, 0.01, NoiseShape::uniform, random)), {});
  REQUIRE(answer.candidates.front().row == a);
  CHECK(answer.candidates.front().same_readings == std::vector<Scene>{{{BlockId{6}}}});
  CHECK(*answer.candidates[0].posterior == Approx(*answer.candidates[1].posterior));
  CHECK(text_report(answer, absolute_readings(library.library(), no_measurements(library.points.size())),
                    kSource)
            .find("cannot tell 1,6 from: 1,7\n") != std::string::npos);
}

TEST_CASE("What cannot be told from a scene does not depend on how many are listed (an equal row)") {
  SyntheticLibrary library(4, 9);
  const std::size_t hidden = library.row_of({{BlockId{5}}});
  std::ranges::copy(library.intact(),
                    library.vertical.begin() + static_cast<std::ptrdiff_t>(hidden * library.table.points));
  Random random(7);
  const Measurements measured = library.measure(0, 0.01, NoiseShape::uniform, random);
  for (const std::size_t top : {1, 3, 10, 40}) {
    LookupSettings settings;
    settings.top = top;
    const Answer answer = locate_damage(absolute_readings(library.library(), measured), settings);
    CHECK(answer.candidates.size() == top);
    REQUIRE(answer.candidates.front().row == 0);
    CHECK(answer.posterior->credible == std::vector<std::size_t>{0});  // far likelier beforehand
    CHECK(answer.candidates.front().same_readings == std::vector<Scene>{{{BlockId{5}}}});
  }
}

TEST_CASE("A library without the wanted numbers of missing blocks is a failure with a reason") {
  const SyntheticLibrary library(2, 3);
  LookupSettings settings;
  settings.prior.missing = {3};
  Random random(8);
  CHECK_THROWS_WITH(locate_damage(absolute_readings(library.library(),
                                                    library.measure(0, 0.1, NoiseShape::uniform, random)),
                                  settings),
                    "--missing: the database has no solved scene with 3 missing blocks, expected of 0, 1, 2");
}

TEST_CASE("If every scene lacks a measured block there is no candidate, and the report says so") {
  const SyntheticLibrary library(2, 3);
  LookupSettings settings;
  settings.prior.missing = {1};
  settings.objective = Objective::paper;
  SyntheticLibrary all_gone(1, 3);
  for (std::size_t row = 1; row < 4; ++row)
    for (std::size_t i = 0; i < all_gone.table.points; ++i)
      all_gone.vertical[row * all_gone.table.points + i] = std::nan("");
  Random random(9);
  const Answer answer = locate_damage(
      absolute_readings(all_gone.library(), all_gone.measure(0, 0.1, NoiseShape::uniform, random)), settings);
  CHECK(answer.candidates.empty());
  CHECK(text_report(answer, absolute_readings(all_gone.library(), no_measurements(all_gone.points.size())),
                    kSource)
            .find("No scene in this database explains") != std::string::npos);
}

TEST_CASE("The JSON report has the candidates in order, the settings used and the database's digest") {
  const SyntheticLibrary library(4, 9);
  Random random(10);
  LookupSettings settings;
  settings.noise.relative = 0.02;
  const Answer answer = locate_damage(
      absolute_readings(library.library(), library.measure(40, 0.01, NoiseShape::uniform, random)), settings);
  const auto json = nlohmann::json::parse(
      json_report(answer, settings,
                  absolute_readings(library.library(), no_measurements(library.points.size())), kSource));
  REQUIRE(json["candidates"].size() == answer.candidates.size());
  for (std::size_t i = 0; i < answer.candidates.size(); ++i) {
    CHECK(json["candidates"][i]["scene"] == to_string(answer.candidates[i].scene, library.layout));
    CHECK(json["candidates"][i]["misfit"] == answer.candidates[i].misfit);
    CHECK(json["candidates"][i]["posterior"] == *answer.candidates[i].posterior);
  }
  CHECK(json["database"]["digest"] == kSource.digest);
  CHECK(json["settings"]["objective"] == "posterior");
  CHECK(json["settings"]["noise"]["relative"] == 0.02);
  settings.objective = Objective::paper;
  const Answer paper = locate_damage(
      absolute_readings(library.library(), library.measure(40, 0.01, NoiseShape::uniform, random)), settings);
  CHECK(nlohmann::json::parse(json_report(
      paper, settings, absolute_readings(library.library(), no_measurements(library.points.size())),
      kSource))["candidates"][0]["posterior"]
            .is_null());
}

TEST_CASE("The CSV report has one quoted scene a line") {
  const SyntheticLibrary library(2, 3);
  Random random(11);
  LookupSettings settings;
  settings.top = 2;
  const Answer answer = locate_damage(
      absolute_readings(library.library(), library.measure(8, 0.0, NoiseShape::uniform, random)), settings);
  const std::string text = csv_report(answer, library.library());
  CHECK(text.find("rank,scene,misfit,posterior,outcome,place,verdict\n1,\"") == 0);
  CHECK(std::count(text.begin(), text.end(), '\n') == 3);
}

TEST_CASE("Labels with quotation marks are fields of the CSV report that are read again") {
  SyntheticLibrary library(4, 6);
  library.layout.blocks[8].label = "the \"loose\" one, #9";
  const std::size_t row = library.row_of({{BlockId{8}}});
  LookupSettings settings;
  settings.top = 1;
  const Answer answer =
      locate_damage(absolute_readings(library.library(), as_measurements(library.table.row(row))), settings);
  const CsvTable table = read_csv(csv_report(answer, library.library()), "report.csv", "rank");
  REQUIRE(table.rows.size() == 1);
  CHECK(table.rows[0].fields[1] == to_string(Scene{{BlockId{8}}}, library.layout));
  CHECK(table.rows[0].fields[1] == "the \"loose\" one, #9");
}

TEST_CASE("Places and numbers are said in plain words") {
  const SyntheticLibrary library(12, 12);
  CHECK(place_in_words(BlockId{9 * 12 + 3}, library.layout) ==
        "course 10, 4th from the left, x 3..4 m, y 9..10 m");
  CHECK(place_in_words(Scene{}, library.layout) == "no block is missing");
  CHECK(ordinal(1) == "1st");
  CHECK(ordinal(2) == "2nd");
  CHECK(ordinal(3) == "3rd");
  CHECK(ordinal(11) == "11th");
  CHECK(ordinal(12) == "12th");
  CHECK(ordinal(21) == "21st");
  CHECK(percent(0.0) == "< 0.1 %");
  CHECK(percent(1e-9) == "< 0.1 %");
  CHECK(percent(0.5) == "50.0 %");
  CHECK(percent(0.99999) == "> 99.9 %");
  CHECK(percent(1.0) == "> 99.9 %");
}
