/// @file Oracle: distances by dense inverses of the covariance of each set of sensors, all sets compared.

#include "lookup/evidence/sensor_choice.h"

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "lookup/evidence/loss_gaussian.h"
#include "tests/lookup/evidence/planned_bridge.h"

using namespace voussoir;
using Eigen::Index;
using test::PlannedBridge;

namespace {

double sum_of_distances(const UnknownBridge& bridge, const std::vector<Index>& rows, double enough) {
  const Eigen::MatrixXd inverse =
      Eigen::MatrixXd(loss_gaussian(bridge, std::nullopt).covariance(rows, rows)).inverse();
  double sum = 0.0;
  for (const BlockId block : blocks_with_sensitivities(bridge)) {
    Eigen::VectorXd signal = loss_gaussian(bridge, block).signal(rows);
    signal = signal.array().isNaN().select(0.0, signal);
    sum += std::min(enough, std::sqrt(signal.dot(inverse * signal)));
  }
  return sum;
}

}  // namespace

TEST_CASE("Each sensor that is chosen helps most beside those before it (dense inverses)", "[plan]") {
  const double enough = GENERATE(2.0, 1e6);
  const PlannedBridge planned(2e-5);
  const std::vector<Index> chosen = rows_that_help(planned.bridge, enough, 5);
  REQUIRE(chosen.size() == 5);
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    std::vector<Index> rows(chosen.begin(), chosen.begin() + static_cast<std::ptrdiff_t>(k) + 1);
    const double best = sum_of_distances(planned.bridge, rows, enough);
    for (Index other = 0; other < planned.bridge.reading.size(); ++other) {
      if (std::ranges::find(chosen.begin(), chosen.begin() + static_cast<std::ptrdiff_t>(k), other) !=
          chosen.begin() + static_cast<std::ptrdiff_t>(k))
        continue;
      rows.back() = other;
      CHECK(sum_of_distances(planned.bridge, rows, enough) <= best * (1.0 + 1e-9));
    }
  }
}

TEST_CASE("No more sensors are chosen than there are, each once", "[plan]") {
  const PlannedBridge planned(2e-5);
  std::vector<Index> chosen = rows_that_help(planned.bridge, 6.0, 100);
  std::ranges::sort(chosen);
  CHECK(chosen == std::vector<Index>{0, 1, 2, 3, 4, 5, 6, 7});
}
