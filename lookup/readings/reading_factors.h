#pragma once
/// @file How readings depend, to first order, on what nobody knows of the bridge.

#include <memory>
#include <vector>

#include "database/records/sensitivities.h"
#include "lookup/readings/library.h"

namespace voussoir {

/// The factors of a comparison's channels (Sensitivities: those of control points): rows are channels. A
/// scene's factors are those of the intact bridge and what the loss of its blocks changes.
struct ReadingFactors {
  std::vector<UncertainParameter> parameters;  ///< those of the bridge, then those of an epoch
  Eigen::MatrixXd basis;                       ///< parameters of the bridge x columns
  SceneFactors intact;
  std::vector<SceneFactors> change;  ///< by block: of its single less the intact bridge's; not known of
                                     ///< singles that do not stand
  std::vector<std::pair<Scene, SceneFactors>> pairs;  ///< the same of pairs that are stored
  FirstOrderResidual residual;

  Eigen::Index of_bridge() const { return intact.bridge.cols(); }  ///< columns
  Eigen::Index of_epoch() const { return intact.epoch.cols(); }
};

/// Null if the intact bridge's are not known in one of the states. Precondition: all channels are control
/// points, whose vertical displacements are all that sensitivities are known of.
std::shared_ptr<const ReadingFactors> reading_factors(const Sensitivities& sensitivities, std::size_t base,
                                                      const std::vector<Channel>& channels,
                                                      std::size_t blocks);

}  // namespace voussoir
