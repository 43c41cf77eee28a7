#pragma once
/// @file The evidence of evidence.h for all rows of a table at once.

#include <vector>

#include "lookup/noise_model.h"
#include "lookup/row_statistics.h"

namespace voussoir {

/// log_likelihood at level 1 of every row. Shapes: uniform, Gaussian, Laplace.
std::vector<double> log_likelihoods(NoiseShape shape, const TableStatistics& statistics, std::size_t count);

/// The logarithm of the mean over the shapes of log_evidence, for every row: in closed form (relative error below 1e-12)
/// where the range of levels does not cut the integral over them short, else by log_evidence itself. Of those latter,
/// scenes less likely by a factor of exp(50) than the likeliest of `rows` may get -infinity. What the other rows get
/// means nothing.
std::vector<double> log_mean_evidences(std::span<const NoiseShape> shapes, const TableStatistics& statistics,
                                       std::span<const std::size_t> rows, std::size_t count);

/// Row by row the logarithm of the mean of exp(logs[i][row]) over i.
std::vector<double> log_mean(const std::vector<std::vector<double>>& logs);

}  // namespace voussoir
