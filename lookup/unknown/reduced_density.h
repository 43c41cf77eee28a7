#pragma once
/// @file The density of scenes' readings in the directions of a screen, in cases that share them: eight
/// scenes side by side, in single precision. Directions are whitened, so that all numbers are of the order of
/// one in some case; logarithms of densities that matter are right to a hundredth. Only what nothing is known
/// of, as collapses by metres, is much larger: such scenes are worked out in double precision.

#include <array>
#include <span>

#include "core/simd/lanes.h"
#include "lookup/unknown/reduced_loss.h"
#include "lookup/unknown/scatter_density.h"
#include "lookup/unknown/unknown_bridge.h"

namespace voussoir {

/// What a case makes of the intact bridge in the directions.
struct ReducedCase {
  double epoch_factor = 0.0;   ///< of E E^T
  double spread_square = 0.0;  ///< of what a signal is beyond that of its losses
  DirectionTriangle others{};  ///< all but A A^T
  /// Logarithm of the density of what lies not in the directions, by kappa, for each of kScreenDirections.
  std::array<ScatterLogs, kScreenDirections.size()> outside{};
  /// log density of readings that the intact bridge would show exactly: the most that any scene can have that
  /// widens its covariance.
  ScatterLogs peaks{};
  double peak = 0.0;  ///< the same, kappa marginalised
};

/// What is the same for all scenes.
struct ReducedQuestion {
  const double *reading, *points,
      *bridge;  ///< in the directions; points: a unit variance at each changed row
  std::span<const ReducedCase> cases;
  // Channels, filled up for lanes: 1 where there is a reading (else 0), and for each its numbers in all
  // directions.
  std::size_t points_of_rows;  ///< channels of a table's row
  const double *is_read, *directions;
  const float* rounded_directions;
  float read;           ///< channels with a reading
  float widest_point;   ///< the largest variance in a direction of a unit variance at each changed row
  float widest_spread;  ///< the largest ReducedCase::spread_square
  float highest_peak;   ///< and ReducedCase::peak
};

/// A scene: its row of the table, and its known losses, of which there is at least one, which may be that of
/// nothing; densities below `least` do not matter.
struct ScenePrediction {
  const double* prediction;
  std::array<const ReducedLoss*, kMostLosses> losses;
  double least;
  float at_points;  ///< 1: what is beyond its losses is uncertain at each point, too; else 0
  float* logs;      ///< log p(readings | scene, case), kappa marginalised, of all cases looked at so far
};

/// Of kFloatLanes scenes with so many losses, in the first directions, and in a few where that matters;
/// -infinity if a scene is impossible, infinity where the estimate fails.
/// `logs` begin with those of the cases before the question's, `before` many; column k of `rises`, which has
/// as many rows as there are cases in all, says how much those can rise to the question's case k. Where that
/// leaves less than what matters, the bound is what is given.
void estimate_log_densities(const ReducedQuestion& question,
                            std::span<const ScenePrediction, kFloatLanes> scenes, std::size_t losses,
                            const Eigen::MatrixXd& rises, std::size_t before);

/// The same in more directions, in the question's cases (`logs` begin with these) where a logarithm matters;
/// none becomes larger.
void refine_log_densities(const ReducedQuestion& question,
                          std::span<const ScenePrediction, kFloatLanes> scenes, std::size_t losses,
                          ScreenDirections directions);

}  // namespace voussoir
