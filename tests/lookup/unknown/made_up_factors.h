#pragma once
/// @file Made-up factors of a synthetic library: what parameters change falls off smoothly, and every block's
/// loss changes it in its own way.

#include <cmath>
#include <random>

#include "lookup/unknown/unknown_evidence.h"
#include "tests/lookup/synthetic_library.h"

namespace voussoir::test {

/// log p(readings | scene, kappa) of these rows in one case.
inline std::vector<ScatterLogs> scatter_logs(const UnknownBridge& bridge, const CaseNoise& noise,
                                             const Observation& observation, const SceneTable& table,
                                             std::span<const std::size_t> rows, int threads) {
  const std::array<CaseTerms, 1> cases = {case_terms(noise)};
  return SceneLikelihoods(bridge, observation, table)(cases, rows, {}, threads);
}

inline constexpr Eigen::Index kLeftIn = 3;  ///< sampled bridges

/// Points x bridges [m]. Every other scene does not stand in the last of them.
inline Eigen::MatrixXd left_in_sampled_bridges(Eigen::Index points, std::size_t scene, double size) {
  const Eigen::MatrixXd left =
      Eigen::MatrixXd::NullaryExpr(points, kLeftIn, [&](Eigen::Index i, Eigen::Index j) {
        return size * std::sin(static_cast<double>(1 + 3 * i + 5 * j) * static_cast<double>(scene + 1));
      });
  return scene % 2 == 0 ? Eigen::MatrixXd(left * Eigen::Vector3d(1.0, 1.0, 0.0).asDiagonal()) : left;
}

/// `columns` of the basis of `columns` + 2 parameters of the bridge, the last but one of which varies
/// together with the first two and the last of which changes nothing; two parameters of an epoch, which leave
/// something in some sampled bridges.
/// Block 1's loss, which makes scenes collapse, has no factors; the pair of blocks 2 and 4 has its own, of
/// which no sampled bridge shows what is left.
inline Sensitivities made_up_sensitivities_of(const SyntheticLibrary& library, Eigen::Index columns = 5,
                                              double size = 1e-4) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  const auto numbers = [&](Eigen::Index rows, Eigen::Index count, double scale) {
    return Eigen::MatrixXd(Eigen::MatrixXd::NullaryExpr(rows, count, [&] { return scale * normal(random); }));
  };
  const auto points = static_cast<Eigen::Index>(library.points.size());
  Sensitivities result;
  for (Eigen::Index i = 0; i < columns + 2; ++i)
    result.parameters.push_back({"stiffness " + std::to_string(i), "1", 0.2, false});
  result.parameters.push_back({"temperature", "K", 10.0, true});
  result.parameters.push_back({"base dy", "m", 1e-3, true});
  result.basis = Eigen::MatrixXd::Identity(columns + 2, columns);
  result.basis.row(columns).head(2) << 0.6, 0.8;
  result.scenes = all_scenes(library.blocks, 1);
  result.scenes.push_back({{BlockId{2}, BlockId{4}}});
  result.make_room(1, points, kLeftIn);
  const SceneFactors intact{numbers(points, columns, size), numbers(points, 2, size)};
  for (std::size_t i = 0; i < result.scenes.size(); ++i) {
    const Scene& scene = result.scenes[i];
    SceneFactors own = intact;
    if (!scene.removed.empty()) {
      own.bridge += numbers(points, columns, 0.2 * size);
      own.epoch += numbers(points, 2, 0.1 * size);
    }
    if (scene.removed.size() == 1) own.left = left_in_sampled_bridges(points, i, 0.1 * size);
    for (Eigen::Index point = 0; point < points; ++point)
      if (scene.lacks(library.points[static_cast<std::size_t>(point)].block))
        for (Eigen::MatrixXd* of : {&own.bridge, &own.epoch, &own.left})
          if (of->size() > 0) of->row(point).setZero();
    if (scene != Scene{{BlockId{1}}}) result.set(0, i, own);
  }
  result.residuals = {
      {numbers(points, 2, 0.05 * size), numbers(points, 1, 0.05 * size), 0.1, 0.05, 0.2, 0.07}};
  result.unevenness = {numbers(points, 3, 0.3 * size)};
  return result;
}

/// A channel for each point.
inline std::shared_ptr<const ReadingFactors> factors_of(const SyntheticLibrary& library,
                                                        const Sensitivities& sensitivities) {
  std::vector<Channel> channels(library.points.size());
  for (std::size_t i = 0; i < channels.size(); ++i) channels[i].point = i;
  return reading_factors(sensitivities, 0, channels, library.blocks);
}

}  // namespace voussoir::test
