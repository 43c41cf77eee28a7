/// @file What datum and tilt of levellings add to readings. Oracle: closed forms.

#include "lookup/readings/nuisance.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/lookup/synthetic_library.h"

using namespace voussoir;

TEST_CASE("A reading has the datum of every levelling that it is the difference of") {
  const test::SyntheticLibrary library(2, 3);
  Comparison comparison = absolute_readings(library.library(), as_measurements(library.intact()));
  const auto deviation = [&](ReadingKind kind) {
    comparison.kind = kind;
    return levelling_columns(comparison, comparison.measured, {.datum = 1e-3})(0, 0);
  };
  CHECK(deviation(ReadingKind::absolute) == Approx(1e-3));
  CHECK(deviation(ReadingKind::change) == Approx(std::sqrt(2.0) * 1e-3));       // after, before
  CHECK(deviation(ReadingKind::load) == Approx(std::sqrt(2.0) * 1e-3));         // with the load, without
  CHECK(deviation(ReadingKind::load_change) == Approx(std::sqrt(4.0) * 1e-3));  // both, at both times
}

TEST_CASE("A levelling turns about the middle of the points read in it") {
  const test::SyntheticLibrary library(2, 5);  // points at x = 0, 1, 1, 2, 2, 3, 3, 4, 4, 5
  Comparison comparison = absolute_readings(library.library(), as_measurements(library.intact()));
  for (std::size_t i = 0; i < library.points.size(); ++i)
    comparison.levelling.push_back(i < 4 ? 0 : kNoLevelling);
  comparison.measured = no_measurements(library.points.size());
  for (const std::size_t read : {0, 1, 3, 9}) comparison.measured.displacement[read] = -1e-3;
  const Eigen::MatrixXd tilt = levelling_columns(comparison, comparison.measured, {.tilt = 0.01});
  Eigen::VectorXd expected = Eigen::VectorXd::Zero(10);
  expected[0] = -0.01, expected[3] = 0.01;  // about x = 1; point 2 has no reading, the others no levelling
  REQUIRE(tilt.cols() == 1);
  CHECK((tilt.col(0) - expected).norm() < 1e-15);
}
