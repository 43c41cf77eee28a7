#pragma once
/// @file The density of one scene's readings in the directions of a screen, in cases that share them.

#include <array>
#include <span>

#include "core/simd/lanes.h"
#include "lookup/evidence/scatter_density.h"
#include "lookup/evidence/unknown_bridge.h"

namespace voussoir {

inline constexpr std::size_t kDirections = 32;
inline constexpr std::size_t kFirstDirections = 8;  ///< that scenes are looked at in first
inline constexpr std::size_t kMoreDirections = 16;  ///< where that leaves them likely enough
inline constexpr std::size_t kEpochColumns = 4;     ///< combinations of an epoch's parameters, the leading

using DirectionVector = std::array<double, kDirections>;
using DirectionTriangle = std::array<double, lower_size(kDirections)>;

/// What a loss adds to a covariance in the directions where a scene has `count` losses: crossed + count *
/// own, and the outer product of what the losses' columns in common sum up to.
struct ReducedPart {
  DirectionTriangle crossed{};  ///< with what the intact bridge has
  DirectionTriangle own{};      ///< without the columns in common
};

/// A loss in the directions.
struct ReducedLoss {
  DirectionVector signal{};
  std::array<double, kDirections* static_cast<std::size_t>(kFirstColumns)> first{};  ///< of A
  std::array<double, kDirections * kEpochColumns> epoch{};  ///< of E, conditions being as the file states
  ReducedPart of_bridge, of_epoch;
  DirectionTriangle model_error{};
  const double* signal_of_rows = nullptr;  ///< in rows of y
};

/// What a case makes of the intact bridge in the directions.
struct ReducedCase {
  double epoch_factor = 0.0;   ///< of E E^T
  double spread_square = 0.0;  ///< of what a signal is beyond that of its losses
  DirectionTriangle others{};  ///< all but A A^T
  /// Logarithm of the density of what lies not in the first few, in more, in all directions, by kappa.
  ScatterLogs outside_few{}, outside_more{}, outside_all{};
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
  // What rows of y are made of: channel, weight and, for each, its numbers in all directions.
  std::size_t rows;
  const std::size_t* channel;
  const double *after, *intact, *directions;
  double changed;  ///< rows of the second epoch
};

/// A scene: its row of the table, and its known losses, of which there is at least one, which may be that of
/// nothing.
struct ScenePrediction {
  const double* prediction;
  std::span<const ReducedLoss* const> losses;
};

/// How many of the directions are looked at beyond the first few.
enum class ScreenDirections { more, all };

/// log p(readings | scene, case), kappa marginalised, in kFirstDirections; -infinity if the scene is
/// impossible. `logs` begins with those of the cases before the question's; column k of `rises`, which has as
/// many rows as there are cases in all, says how much those can rise to the question's case k. Where that
/// leaves less than `least`, the bound is what is given.
void estimate_log_densities(const ReducedQuestion& question, const ScenePrediction& scene, double least,
                            const Eigen::MatrixXd& rises, std::span<double> logs);

/// The same in more directions, of those of the question's cases whose logarithms are at least `least`; none
/// becomes larger.
void refine_log_densities(const ReducedQuestion& question, const ScenePrediction& scene,
                          ScreenDirections directions, double least, std::span<double> logs);

}  // namespace voussoir
