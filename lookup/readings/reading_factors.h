#pragma once
/// @file How readings depend, to first order, on what nobody knows of the bridge.

#include <memory>
#include <vector>

#include "database/records/sensitivities.h"
#include "database/records/signal_factors.h"
#include "lookup/readings/library.h"

namespace voussoir {

/// Columns of the basis that count as they are when two blocks are gone. What the others give one block's
/// signal and another's counts as independent: measured on 300 pairs of the reference bridge, that leaves out
/// 0.2 % of what the signals have in common (median; at most 7 %, of neighbours).
inline constexpr Eigen::Index kLeadingColumns = 64;

/// The first of them, which leave out 1 % (median; at most 17 %): enough to estimate with. And so many
/// columns of a loss's own, which leave out a ten-thousandth of its variance.
inline constexpr Eigen::Index kFirstColumns = 8;
inline constexpr Eigen::Index kFirstOwnColumns = 24;

/// What one loss changes in the channels' factors, widened by what the first order leaves of it, in a form
/// whose size does not grow with the basis. Rows are channels; zero where the loss leaves no reading.
struct LossFactors {
  Eigen::MatrixXd lead;   ///< of the basis's leading columns
  Eigen::MatrixXd epoch;  ///< of the parameters of an epoch
  SignalFactors signal;   ///< of all columns
  bool known() const { return lead.rows() > 0; }
};

/// The factors of a comparison's channels (Sensitivities: those of control points). A scene's factors are
/// those of the intact bridge and what the loss of its blocks changes. Refers to the sensitivities.
struct ReadingFactors {
  const Sensitivities* sensitivities = nullptr;
  std::size_t base = 0;            ///< state of the channels without loads
  std::vector<Channel> channels;   ///< their sensors are not looked at
  SceneFactors intact;             ///< with all columns
  Eigen::MatrixXd intact_product;  ///< channels x channels: A A^T of the intact bridge
  Eigen::MatrixXd
      signal_product;  ///< the sum over losses of what they change alone, nearly: where losses show
  std::vector<LossFactors> blocks;  ///< not known of singles that do not stand
  std::vector<std::pair<Scene, LossFactors>>
      several;  ///< of scenes of several blocks with their own, ascending
  FirstOrderResidual residual;

  const std::vector<UncertainParameter>& parameters() const { return sensitivities->parameters; }
  Eigen::Index of_bridge() const { return intact.bridge.cols(); }  ///< columns
  Eigen::Index of_epoch() const { return intact.epoch.cols(); }
  /// All columns of a scene, as far as they are known: of unknown losses nothing is added to the intact
  /// bridge's.
  SceneFactors of(const Scene& scene) const;
};

/// Null if the intact bridge's are not known in one of the states. Precondition: all channels are control
/// points, whose vertical displacements are all that sensitivities are known of.
std::shared_ptr<const ReadingFactors> reading_factors(const Sensitivities& sensitivities, std::size_t base,
                                                      std::vector<Channel> channels, std::size_t blocks);

}  // namespace voussoir
