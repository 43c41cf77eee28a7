#pragma once
/// @file Made-up factors of a synthetic library: what parameters change falls off smoothly, and every block's
/// loss changes it in its own way.

#include <random>

#include "lookup/evidence/unknown_bridge.h"
#include "tests/lookup/synthetic_library.h"

namespace voussoir::test {

/// `columns` of the basis of `columns` + 2 parameters of the bridge, two parameters of an epoch. Block 1's
/// loss, which makes scenes collapse, has no factors.
inline std::shared_ptr<const ReadingFactors> made_up_factors(const SyntheticLibrary& library,
                                                             Eigen::Index columns = 5, double size = 1e-4) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  const auto numbers = [&](Eigen::Index rows, Eigen::Index count, double scale) {
    return Eigen::MatrixXd(Eigen::MatrixXd::NullaryExpr(rows, count, [&] { return scale * normal(random); }));
  };
  const auto points = static_cast<Eigen::Index>(library.points.size());
  ReadingFactors result;
  for (Eigen::Index i = 0; i < columns + 2; ++i)
    result.parameters.push_back({"stiffness " + std::to_string(i), "1", 0.2, false});
  result.parameters.push_back({"temperature", "K", 10.0, true});
  result.parameters.push_back({"base dy", "m", 1e-3, true});
  result.basis = Eigen::MatrixXd::Identity(columns + 2, columns);
  result.intact = {numbers(points, columns, size), numbers(points, 2, size)};
  for (std::size_t block = 0; block < library.blocks; ++block)
    result.change.push_back(
        block == 1 ? SceneFactors{}
                   : SceneFactors{numbers(points, columns, 0.2 * size), numbers(points, 2, 0.1 * size)});
  result.pairs.emplace_back(
      Scene{{BlockId{2}, BlockId{4}}},
      SceneFactors{numbers(points, columns, 0.3 * size), numbers(points, 2, 0.1 * size)});
  result.residual = {numbers(points, 2, 0.05 * size), numbers(points, 1, 0.05 * size), 0.1, 0.05};
  return std::make_shared<const ReadingFactors>(std::move(result));
}

}  // namespace voussoir::test
