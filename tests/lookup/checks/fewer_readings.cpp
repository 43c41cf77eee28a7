/// @file Readings without those of some sensors. Oracle: the same readings made without them; by hand.

#include "lookup/checks/fewer_readings.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/error.h"
#include "tests/lookup/synthetic_library.h"

namespace voussoir {
namespace {

SensorResidual residual(std::size_t point, double error, bool disagrees) {
  return {
      .point = point, .reading = 0.0, .predicted = 0.0, .scale = 1.0, .error = error, .disagrees = disagrees};
}

/// Changes of an intact wall, of which the third point reads nothing.
Comparison changes(const test::SyntheticLibrary& library) {
  Comparison comparison = absolute_readings(library.library(), no_measurements(library.points.size()));
  comparison.kind = ReadingKind::change;
  for (std::size_t i = 0; i < library.points.size(); ++i) {
    comparison.measured.displacement[i] = library.intact()[i] + (i % 2 == 0 ? 1e-6 : -1e-6);
    comparison.measured.sigma[i] = 1e-5;
  }
  comparison.measured.displacement[2] = std::nan("");
  comparison.measured.silent[2] = true;
  return comparison;
}

}  // namespace

TEST_CASE("Readings that are left out are no sensors, silent ones neither, and names must be in the file") {
  const test::SyntheticLibrary library(3, 4);
  const Comparison all = changes(library);
  const Comparison fewer = without_readings(all, channels_at(all, "T1,T3"));
  CHECK(fewer.measured.count() == all.measured.count() - 1);
  CHECK(std::isnan(fewer.measured.displacement[0]));
  CHECK_FALSE(fewer.measured.silent[2]);
  CHECK(fewer.measured.displacement[1] == all.measured.displacement[1]);
  CHECK_THROWS_WITH(channels_at(fewer, "T1"), Catch::Contains("--without: 'T1' has no row in the file"));
  CHECK_THROWS_AS(channels_at(all, "T99"), InputError);
}

TEST_CASE("Suspects are the two that disagree most, and only of answers that they may keep from being one") {
  const std::vector<SensorResidual> residuals = {residual(3, 5.0, true), residual(4, -9.0, true),
                                                 residual(5, 20.0, false), residual(6, 4.0, true)};
  CHECK(suspects_among(residuals) == std::vector<std::vector<std::size_t>>{{4}, {3}});
  CHECK(suspects_among({residual(5, 20.0, false)}).empty());
  Answer answer;
  answer.posterior = Posterior{{0.0, {}, {}}, {0.99}, {0.01, 0.99}, {0}};
  answer.fit = Fit{true, 0.5, "", {{4}}};
  CHECK(suspects_of(answer).empty());  // located
  answer.fit->explained = false;
  CHECK(suspects_of(answer) == std::vector<std::vector<std::size_t>>{{4}});
  answer.posterior = Posterior{{0.0, {}, {}}, {0.5}, {0.5, 0.5}, {0}};
  answer.fit->explained = true;
  CHECK(suspects_of(answer).size() == 1);  // cannot tell
  answer.fit->suspects.clear();
  CHECK(suspects_of(answer).empty());
}

TEST_CASE("An answer without a wrong reading is that to the file without it (asked so)") {
  const test::SyntheticLibrary library(3, 4);
  Comparison wrong = changes(library);
  wrong.measured.displacement[5] += 1e-2;  // a thousand times its error
  LookupSettings settings;
  settings.known_bridge = true;
  settings.noise = {NoiseShape::gaussian, 0.0};
  const Answer answer = locate_damage(wrong, settings);
  REQUIRE(answer.without);
  CHECK(answer.without->channels == std::vector<std::size_t>{5});
  const Answer alone = locate_damage(without_readings(wrong, std::vector<std::size_t>{5}), settings);
  CHECK(alone.fit->explained);
  CHECK(answer.without->answer->posterior->probability.values == alone.posterior->probability.values);
}

TEST_CASE("No sensor is held against what hangs on a reading that may be wrong, nor against what falls") {
  const auto told = [](const Answer& answer) {
    std::vector<std::size_t> points;
    for (const SensorResidual& sensor : told_residuals(answer))
      if (sensor.disagrees) points.push_back(sensor.point);
    return points;
  };
  Answer answer;
  answer.known_bridge = false;
  answer.candidates.emplace_back();
  answer.residuals = {residual(0, 20.0, true), residual(1, -9.0, true), residual(2, 0.5, false)};
  CHECK(told(answer) == std::vector<std::size_t>{0, 1});
  CHECK(are_sensors_judged(answer));
  answer.without = AnswerWithout{{1}, nullptr};
  CHECK(told(answer) == std::vector<std::size_t>{1});
  CHECK_FALSE(are_sensors_judged(answer));
  answer.without.reset();
  answer.candidates.front().outcome = Outcome::collapsed;
  CHECK(told(answer) == std::vector<std::size_t>{0, 1});  // what is expected then is no snapshot
  answer.known_bridge = true;
  CHECK(told(answer).empty());
}

}  // namespace voussoir
