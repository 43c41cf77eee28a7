#include "lookup/evidence/unknown_evidence.h"

#include <limits>

#include "core/threads.h"

namespace voussoir {
namespace {

using Eigen::Index;

constexpr double kImpossible = -std::numeric_limits<double>::infinity();
constexpr std::size_t kBlockRows = 16;  // that a thread takes at a time

LowerTriangle lower_of(const Eigen::MatrixXd& matrix) {
  LowerTriangle lower;
  lower.reserve(lower_size(static_cast<std::size_t>(matrix.rows())));
  for (Index i = 0; i < matrix.rows(); ++i)
    for (Index j = 0; j <= i; ++j) lower.push_back(matrix(i, j));
  return lower;
}

/// Row by row, filled up for lanes.
void store_rows(const Eigen::MatrixXd& matrix, std::vector<double>& rows) {
  const std::size_t width = padded(static_cast<std::size_t>(matrix.cols()));
  rows.assign(static_cast<std::size_t>(matrix.rows()) * width, 0.0);
  for (Index i = 0; i < matrix.rows(); ++i)
    for (Index j = 0; j < matrix.cols(); ++j)
      rows[static_cast<std::size_t>(i) * width + static_cast<std::size_t>(j)] = matrix(i, j);
}

/// Memory of one thread.
struct Work {
  ScatterDensity density;
  std::vector<double> difference, columns;
  LowerTriangle noise, bridge;
};

ScatterLogs logs_of(const SceneGaussian& scene, const LowerTriangle& common, Work& work) {
  const auto n = static_cast<std::size_t>(scene.difference.size());
  work.difference.assign(scene.difference.begin(), scene.difference.end());
  work.noise = common;
  for (std::size_t i = 0; i < n; ++i) work.noise[lower_size(i) + i] += scene.variance[static_cast<Index>(i)];
  for (const Eigen::MatrixXd& columns : {scene.factors.epoch, scene.columns}) {
    store_rows(columns, work.columns);
    add_outer_product(work.columns, n, work.noise);
  }
  work.bridge.assign(lower_size(n), 0.0);
  store_rows(scene.factors.bridge, work.columns);
  add_outer_product(work.columns, n, work.bridge);
  return work.density(work.difference, work.noise, work.bridge);
}

}  // namespace

std::vector<ScatterLogs> scatter_logs(const UnknownBridge& bridge, const Observation& observation,
                                      const SceneTable& table, std::span<const std::size_t> rows,
                                      int threads) {
  const LowerTriangle common = lower_of(bridge.noise);
  std::vector<ScatterLogs> result(rows.size());
  for_each_index_on_threads((rows.size() + kBlockRows - 1) / kBlockRows, threads, [&](std::size_t block) {
    Work work;
    for (std::size_t i = block * kBlockRows; i < std::min(rows.size(), (block + 1) * kBlockRows); ++i) {
      const auto scene = scene_gaussian(bridge, observation, table, rows[i]);
      if (scene)
        result[i] = logs_of(*scene, common, work);
      else
        result[i].fill(kImpossible);
    }
  });
  return result;
}

}  // namespace voussoir
