/// @file Oracle: the evidence of scenes (unknown_evidence.h, which has the dense definition for its own).

#include "lookup/plan/loss_gaussian.h"

#include <catch2/catch.hpp>

#include "tests/lookup/plan/planned_bridge.h"
#include "tests/lookup/unknown/dense_normal.h"

using namespace voussoir;
using test::PlannedBridge;

TEST_CASE("The Gaussian of a loss gives readings the density that their evidence has", "[unknown-bridge]") {
  PlannedBridge planned(2e-5, 3e-5);
  const UnknownBridge& bridge = planned.bridge;
  int compared = 0;
  const auto compare_with = [&](std::optional<BlockId> lost, const Scene& scene) {
    const std::vector<std::size_t> rows = {planned.library.row_of(scene)};
    const LossGaussian loss = loss_gaussian(bridge, planned.noise, lost);
    if (loss.signal.hasNaN()) return;
    const auto logs =
        test::scatter_logs(bridge, planned.noise, planned.observation, planned.library.table, rows, 1)
            .front();
    const Eigen::MatrixXd scatter =
        in_rows(bridge.rows, bridge.factors->intact.bridge, bridge.factors->of(scene).bridge);
    for (std::size_t k = 0; k < kScatterFactors.size(); ++k)
      CHECK(test::log_normal(bridge.reading - loss.signal,
                             loss.covariance + (kScatterFactors[k] - 1.0) * scatter * scatter.transpose()) ==
            Approx(logs[k]).epsilon(1e-9));
    ++compared;
  };
  compare_with(std::nullopt, {});
  for (const BlockId block : blocks_with_sensitivities(bridge)) compare_with(block, {{block}});
  CHECK(compared == 8);  // none and the seven of eight blocks below the sensors that stand
}

TEST_CASE("A loss takes the sensors on its block with it (by hand)", "[unknown-bridge]") {
  const PlannedBridge planned(2e-5);
  const BlockId on_top{9};  // second of the highest course: points 3 and 4
  const LossGaussian loss = loss_gaussian(planned.bridge, planned.noise, on_top);
  CHECK(rows_with_reading(loss.signal) == std::vector<Eigen::Index>{0, 1, 4, 5, 6, 7});
  const std::vector<BlockId> blocks = blocks_with_sensitivities(planned.bridge);
  CHECK(blocks.size() == 11);
  CHECK(std::ranges::find(blocks, BlockId{1}) == blocks.end());  // which lets all fall
}
