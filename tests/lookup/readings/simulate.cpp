#include "lookup/readings/simulate.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/error.h"
#include "tests/lookup/synthetic_library.h"

using namespace voussoir;

namespace {

/// A comparison with a synthetic library's control points.
Comparison comparison_with(const test::SyntheticLibrary& library, ReadingKind kind) {
  Comparison comparison = absolute_readings(library.library(), no_measurements(library.points.size()));
  comparison.kind = kind;
  return comparison;
}

}  // namespace

TEST_CASE(
    "Simulated readings have the noise that was asked for, and silent sensors on missing blocks and by "
    "chance") {
  std::vector<double> truth(20'000, -2e-3);
  truth[7] = std::nan("");
  for (const NoiseShape shape :
       {NoiseShape::uniform, NoiseShape::gaussian, NoiseShape::laplace, NoiseShape::student}) {
    Random random(12);
    const NoiseModel noise{shape, 0.05, 1e-5, 8.0, 0.1};
    const Measurements measured = simulate_readings(truth, noise, random);
    CHECK(measured.silent[7]);
    double sum = 0.0, square = 0.0;
    for (const double value : measured.displacement)
      if (!std::isnan(value)) {
        sum += value + 2e-3;
        square += (value + 2e-3) * (value + 2e-3);
      }
    const auto n = static_cast<double>(measured.count());
    const double sigma = 0.05 * 2e-3 + 1e-5;
    INFO(to_string(shape));
    CHECK(n / 20'000 == Approx(0.9).margin(0.01));
    CHECK(sum / n == Approx(0.0).margin(4.0 * sigma / std::sqrt(n)));
    CHECK(std::sqrt(square / n) == Approx(sigma * standard_deviation(shape)).epsilon(0.05));
  }
}

TEST_CASE(
    "Simulated changes are the scene less the intact bridge, and two epochs differ by them (closed form)") {
  const test::SyntheticLibrary library(3, 6);
  const SensorList list = control_point_sensors(library.points);
  const Comparison comparison = comparison_with(library, ReadingKind::change);
  const NoiseModel exact{.shape = NoiseShape::gaussian, .relative = 0.0, .silence = 0.0};
  Random random(5);
  const ReadingsFile file =
      simulate_file(blank_file(list, ReadingKind::change, {}), comparison, 2, exact, {}, random);
  REQUIRE(file.readings.size() == library.points.size());
  for (std::size_t i = 0; i < file.readings.size(); ++i) {
    const double change = library.table.row(2)[i] - library.intact()[i];
    CHECK(file.readings[i].value == Approx(change).margin(1e-18));
    CHECK(file.readings[i].before == library.intact()[i]);
    CHECK(file.readings[i].after == Approx(library.table.row(2)[i]).epsilon(1e-12));
  }
}

TEST_CASE(
    "Datum and tilt of a levelling move all heights by a straight line, drawn with the stated deviations") {
  const test::SyntheticLibrary library(2, 5);
  const SensorList list = control_point_sensors(library.points);
  const Comparison comparison = comparison_with(library, ReadingKind::change);
  const NoiseModel exact{.shape = NoiseShape::gaussian, .relative = 0.0, .silence = 0.0};
  const Nuisance levelling{.datum = 2e-4, .tilt = 1e-4};
  double shifts = 0.0, tilts = 0.0;
  constexpr int kDraws = 2000;
  Random random(6);
  for (int draw = 0; draw < kDraws; ++draw) {
    const ReadingsFile file =
        simulate_file(blank_file(list, ReadingKind::change, {}), comparison, 0, exact, levelling, random);
    const auto at = [&](std::size_t i) {
      return file.readings[i].value;
    };  // the change of the intact bridge is none
    const double tilt = (at(9) - at(0)) / (library.points[9].position.x() - library.points[0].position.x());
    CHECK(at(4) - at(0) ==
          Approx(tilt * (library.points[4].position.x() - library.points[0].position.x())).margin(1e-15));
    tilts += tilt * tilt / kDraws;
    shifts += std::pow(0.5 * (at(9) + at(0)), 2) / kDraws;  // in the middle of the points
  }
  // The mean of n squares of a Gaussian is off by sqrt(2 / n) of itself: four times that, halved by the root.
  // A change is the difference of two levellings.
  CHECK(std::sqrt(0.5 * tilts) == Approx(levelling.tilt).epsilon(2.0 * std::sqrt(2.0 / kDraws)));
  CHECK(std::sqrt(0.5 * shifts) == Approx(levelling.datum).epsilon(2.0 * std::sqrt(2.0 / kDraws)));
}

TEST_CASE("A simulated levelling turns about the middle of its own points (their errors add up to nothing)") {
  const test::SyntheticLibrary library(2, 5);
  Comparison comparison = comparison_with(library, ReadingKind::absolute);
  for (std::size_t i = 0; i < library.points.size(); ++i)
    comparison.levelling.push_back(i < 4 ? 0 : kNoLevelling);
  const NoiseModel exact{.shape = NoiseShape::gaussian, .relative = 0.0, .silence = 0.0};
  Random random(7);
  const ReadingsFile file =
      simulate_file(blank_file(control_point_sensors(library.points), ReadingKind::absolute, {}), comparison,
                    0, exact, {.tilt = 1e-4}, random);
  double sum = 0.0, size = 0.0;
  for (std::size_t i = 0; i < library.points.size(); ++i) {
    const double error = file.readings[i].value - library.intact()[i];
    sum += error, size += std::abs(error);
    if (i >= 4) CHECK(error == 0.0);
  }
  CHECK(size > 1e-6);
  CHECK(std::abs(sum) < 1e-12);
}

TEST_CASE("What a load adds to a scene that falls is no reading, and no other database would have one") {
  test::SyntheticLibrary library(2, 5);
  std::fill_n(library.vertical.begin() + static_cast<std::ptrdiff_t>(3 * library.table.points),
              library.table.points, std::nan(""));
  const NoiseModel exact{.shape = NoiseShape::gaussian, .relative = 0.0, .silence = 0.0};
  const auto message = [&](ReadingKind kind) {
    Random random(8);
    try {
      simulate_file(blank_file(control_point_sensors(library.points), kind, {"axle"}),
                    comparison_with(library, kind), 3, exact, {}, random);
    } catch (const Failure& failure) {
      return std::string(failure.what());
    }
    return std::string("no error");
  };
  CHECK(message(ReadingKind::load) ==
        "scene 1,3 does not stand both under the load and without it, so that nobody reads what the load "
        "adds: expected a scene that does");
  CHECK_THAT(message(ReadingKind::absolute), Catch::Matchers::Contains("--collapses field"));
}
