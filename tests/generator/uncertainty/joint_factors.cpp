/// @file Columns of errors in several states. Oracle: second moments, summed up bridge by bridge.

#include "generator/uncertainty/joint_factors.h"

#include <catch2/catch.hpp>

#include "core/random.h"

namespace voussoir {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kPoints = 5;

VectorXd draw(Random& random) {
  VectorXd error(kPoints);
  for (double& value : error) value = 1e-4 * random.gaussian();
  return error;
}

/// Errors of so many bridges without and with a load, which adds a tenth of its own.
std::vector<StateErrors> errors_of(std::size_t bridges) {
  Random random(5);
  std::vector<StateErrors> errors(2);
  for (std::size_t b = 0; b < bridges; ++b) {
    errors[0].push_back(draw(random));
    errors[1].push_back(errors[0].back() + 0.1 * draw(random));
  }
  return errors;
}

MatrixXd moments(const StateErrors& first, const StateErrors& second) {
  MatrixXd sum = MatrixXd::Zero(kPoints, kPoints);
  for (std::size_t b = 0; b < first.size(); ++b) sum += first[b] * second[b].transpose();
  return sum / static_cast<double>(first.size());
}

}  // namespace

TEST_CASE("Factors of several states have the errors' second moments, of the states and between them") {
  for (const std::size_t bridges : {3, 40}) {  // fewer than there are numbers of a bridge, and more
    const auto errors = errors_of(bridges);
    const std::vector<MatrixXd> factors = joint_factors(errors, kPoints);
    REQUIRE(factors.size() == 2);
    CHECK(factors[0].cols() == std::min<Index>(static_cast<Index>(bridges), 2 * kPoints));
    for (std::size_t s = 0; s < 2; ++s)
      for (std::size_t t = 0; t < 2; ++t)
        CHECK((factors[s] * factors[t].transpose()).isApprox(moments(errors[s], errors[t]), 1e-9));
  }
}

TEST_CASE("What a load adds is off by the difference of the factors, not by both states' errors together") {
  const auto errors = errors_of(40);
  StateErrors added;
  for (std::size_t b = 0; b < 40; ++b) added.push_back(errors[1][b] - errors[0][b]);
  const std::vector<MatrixXd> factors = joint_factors(errors, kPoints);
  const MatrixXd difference = factors[1] - factors[0];
  CHECK((difference * difference.transpose()).isApprox(moments(added, added), 1e-7));
}

TEST_CASE("States in which all bridges show the same have the same factors, in no more columns than one") {
  auto errors = errors_of(40);
  errors[1] = errors[0];
  const std::vector<MatrixXd> factors = joint_factors(errors, kPoints);
  CHECK(factors[0].cols() == kPoints);
  CHECK(factors[1].isApprox(factors[0], 1e-13));
}

TEST_CASE(
    "A state counts the bridges that stand in it, and what it has in common with others is understated") {
  auto errors = errors_of(40);
  for (std::size_t b = 0; b < 10; ++b) errors[1][b].resize(0);
  const std::vector<MatrixXd> factors = joint_factors(errors, kPoints);
  const StateErrors unloaded(errors[0].begin() + 10, errors[0].end()),
      loaded(errors[1].begin() + 10, errors[1].end());
  CHECK((factors[0] * factors[0].transpose()).isApprox(moments(errors[0], errors[0]), 1e-9));
  CHECK((factors[1] * factors[1].transpose()).isApprox(moments(loaded, loaded), 1e-9));
  // 30 bridges have both; the states count 40 and 30.
  CHECK((factors[0] * factors[1].transpose())
            .isApprox(std::sqrt(30.0 / 40.0) * moments(unloaded, loaded), 1e-9));
}

TEST_CASE("Where nothing stands, or nothing was drawn, there is a column of zeros") {
  const std::vector<StateErrors> fallen(2, StateErrors(7));
  for (const auto& errors : {fallen, std::vector<StateErrors>(2)})
    for (const MatrixXd& factor : joint_factors(errors, kPoints)) CHECK(factor.isZero(0.0));
}

}  // namespace voussoir
