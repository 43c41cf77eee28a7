#pragma once
/// @file The probability (density) of the readings given scenes, for shapes of the noise at one level.

#include <array>
#include <optional>
#include <vector>

#include "database/records/database.h"
#include "lookup/evidence/nuisance_likelihood.h"
#include "lookup/evidence/row_at_levels.h"
#include "lookup/readings/observation.h"

namespace voussoir {

/// Shapes whose likelihoods follow from the same sums over a row's errors: uniform alone, or others.
using Shapes = std::span<const NoiseShape>;

/// For each shape log p(readings | scene, level) of these rows of a table, in their order; -infinity for
/// impossible scenes. Densities are per metre for each reading.
std::vector<std::vector<double>> log_likelihoods_at(const Observation& observation, Shapes shapes,
                                                    double level, const SceneTable& table,
                                                    std::span<const std::size_t> rows);

inline constexpr std::size_t kMostShapes = 2;

/// The same of one row after the other, each at many levels.
class RowLikelihood {
 public:
  /// At most kMostShapes. All of them outlive it.
  RowLikelihood(const Observation& observation, Shapes shapes);

  /// From now on it is this row. Precondition: every reading has a prediction.
  void take(std::span<const double> prediction);

  /// For each of the shapes.
  std::array<double, kMostShapes> at(double level);

 private:
  const Observation& observation_;
  Shapes shapes_;
  bool is_soft_;  // bounded errors beside others
  RowAtLevels row_;
  std::optional<NuisanceStatistics> levelled_;  // in its place
};

/// For each of the rows a number that none of these exceeds by more than a millionth: where bounded errors
/// take long, one that takes less.
std::vector<double> highest_likelihoods_at(const Observation& observation, Shapes shapes, double level,
                                           const SceneTable& table, std::span<const std::size_t> rows);

/// For each of the rows an estimate of the largest of these over all levels and shapes, from statistics at
/// this level: right if all errors grow with the level alone; of Student's t the likelihood at this level, of
/// bounded errors too high where some come near the bound.
std::vector<double> estimated_peaks(const Observation& observation, Shapes shapes, double level,
                                    const SceneTable& table, std::span<const std::size_t> rows);

}  // namespace voussoir
