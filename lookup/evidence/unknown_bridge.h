#pragma once
/// @file Readings of a bridge that is not exactly known, as one Gaussian for each scene:
///
///   y | scene, kappa ~ N(mean, kappa A A^T + E E^T + noise)
///
/// A, E: what a standard deviation of the bridge's and of each epoch's parameters changes (ReadingFactors);
/// kappa: by how much the bridge's scatter differs from what the bridge file states (scatter_factor.h);
/// noise: instruments, levellings, the model's own error, and what the first order leaves.
///
/// A pair's factors are those of the intact bridge and what its two blocks change alone, unless the database
/// has its own. Of what a scene's signal is beyond that of its blocks with known factors, the whole counts as
/// uncertain as signals typically are: by one factor, and once more at each point by itself. So scenes
/// without factors (that collapse, or with a block whose loss alone makes a collapse) are told less sharply,
/// not excluded.

#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>

#include "lookup/evidence/loss.h"

namespace voussoir {

/// What the first of two epochs tells.
enum class Epochs {
  change,  ///< only the difference counts: readings before have a datum of their own at every point
  both     ///< the first's are displacements since the bridge carried nothing, and teach what it is like
};

struct UnknownBridge {
  std::vector<ReadingRow> rows;
  Eigen::VectorXd reading;                    ///< [m] less what the intact bridge shows
  Eigen::VectorXd movement;                   ///< [m] of the intact bridge, as a common factor counts it
  SceneFactors intact;                        ///< epochs' parameters: a column for each epoch and parameter
  Eigen::MatrixXd noise;                      ///< [m2] of all scenes
  std::vector<Loss> blocks;                   ///< by block
  std::vector<std::pair<Scene, Loss>> pairs;  ///< with factors of their own, in ascending order
  Eigen::Index epochs = 1;                    ///< in y, each with its own columns
  double spread = 0.0;  ///< [-] standard deviation of a signal as a share of it, where it is not known better
  double scale = 0.0;   ///< [-] Observation::unknown_scale as far as it was asked for
};

/// The instruments' errors are those of a noise level, in shares of what was read; `scale`: Nuisance::scale.
/// Preconditions: the comparison has factors, the observation Gaussian noise and at least one reading.
UnknownBridge unknown_bridge(const Comparison& comparison, const Observation& observation, double level,
                             double scale, Epochs epochs);

/// The losses that a scene is made of, of which factors are known: those of its blocks, or its own.
std::vector<const Loss*> known_losses(const UnknownBridge& bridge, const Scene& scene);

/// One scene's Gaussian. Rows are those of y.
struct SceneGaussian {
  Eigen::VectorXd difference;  ///< [m] y less its mean
  SceneFactors factors;
  Eigen::VectorXd variance;  ///< [m2] beside UnknownBridge::noise
  Eigen::MatrixXd columns;   ///< [m] and columns * columns^T

  /// kappa A A^T + E E^T + noise
  Eigen::MatrixXd covariance(const UnknownBridge& bridge, double kappa) const;
};

/// Nothing if the scene is impossible: a block with a reading is missing.
std::optional<SceneGaussian> scene_gaussian(const UnknownBridge& bridge, const Observation& observation,
                                            const SceneTable& table, std::size_t row);

}  // namespace voussoir
