#pragma once
/// @file The evidence over an unknown level in closed form, where all errors grow with the level, for many
/// rows at once.

#include <vector>

#include "lookup/evidence/row_statistics.h"
#include "lookup/readings/noise_model.h"

namespace voussoir {

/// The integral of a likelihood over all levels is that of a power: exp(constant - order log(sum) -
/// sum_log_scale), where `sum` is the shape's own statistic. It stands for log_evidence (relative error below
/// 1e-12) for sums from `least` to `most`; beyond, the range of levels cuts it short.
struct LevelIntegral {
  NoiseShape shape;
  double order;
  double constant;
  double least;
  double most;
};
LevelIntegral level_integral(NoiseShape shape, std::size_t count);

/// The logarithm of the mean over the shapes of log_evidence, for every row: in closed form where that
/// stands, else by log_evidence itself. Of the latter, scenes less likely by a factor of exp(50) than
/// exp(best) may get -infinity; `best` rises to the largest evidence.
std::vector<double> log_mean_evidences(std::span<const LevelIntegral> integrals,
                                       const TableStatistics& statistics, std::size_t count, double& best);

/// Row by row the logarithm of the mean of exp(logs[i][row]) over i.
std::vector<double> log_mean(std::vector<std::vector<double>> logs);

}  // namespace voussoir
