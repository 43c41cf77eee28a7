#pragma once
/// @file How readings depend, to first order, on what nobody knows of the bridge.

#include <memory>
#include <vector>

#include "database/records/sensitivities.h"
#include "lookup/readings/channel_columns.h"
#include "lookup/readings/library.h"

namespace voussoir {

/// Leading columns of a loss that are enough to estimate with: of D (kLeadingColumns), they leave out 1 % of
/// what the signals of two losses have in common (median of 300 pairs of the reference bridge; at most 17 %).
inline constexpr Eigen::Index kFirstColumns = 8;
/// And of a loss's own, B: they leave out a ten-thousandth of its variance.
inline constexpr Eigen::Index kFirstOwnColumns = 24;

/// What one loss changes in the channels' factors, widened by what the first order leaves of it, in a form
/// whose size does not grow with the basis. Zero where the loss leaves no reading.
struct LossFactors {
  Eigen::MatrixXd epoch;  ///< of an epoch: channels x columns (ReadingFactors::of_epoch)
  ChannelColumns lead;    ///< the leading columns of D
  ChannelColumns own;     ///< of all columns of D: B and H (SignalFactors)
  ChannelColumns intact;
  bool known() const { return epoch.rows() > 0; }
};

/// The factors of a comparison's channels (Sensitivities: those of control points). A scene's factors are
/// those of the intact bridge and what the loss of its blocks changes. Refers to the sensitivities.
struct ReadingFactors {
  const Sensitivities* sensitivities = nullptr;
  std::size_t base = 0;            ///< state of the channels without loads
  std::vector<Channel> channels;   ///< their sensors are not looked at
  SceneFactors intact;             ///< with all columns; nothing is left apart
  Eigen::MatrixXd intact_product;  ///< channels x channels: A A^T of the intact bridge
  Eigen::MatrixXd
      signal_product;  ///< the sum over losses of what they change alone, nearly: where losses show
  std::vector<LossFactors> blocks;  ///< not known of singles that do not stand
  std::vector<std::pair<Scene, LossFactors>>
      several;  ///< of scenes of several blocks with their own, ascending
  FirstOrderResidual residual;
  Eigen::MatrixXd unevenness;  ///< channels x channels [m2]: covariance of what differs from part to part
                               ///< of the bridge in an epoch; zero if nothing does

  const std::vector<UncertainParameter>& parameters() const { return sensitivities->parameters; }
  Eigen::Index of_bridge() const { return intact.bridge.cols(); }  ///< columns
  /// Columns: the parameters of an epoch, then what they leave of signals in each of some sampled bridges,
  /// which is zero of the intact bridge. Losses in the same bridge leave theirs together.
  Eigen::Index of_epoch() const { return intact.epoch.cols(); }
  Eigen::Index epoch_parameters() const { return sensitivities->of_epoch(); }
  /// All columns of a scene, widened like LossFactors, as far as they are known: of unknown losses nothing is
  /// added to the intact bridge's.
  SceneFactors of(const Scene& scene) const;
};

/// Null if the intact bridge's are not known in one of the states. Precondition: all channels are control
/// points, whose vertical displacements are all that sensitivities are known of.
std::shared_ptr<const ReadingFactors> reading_factors(const Sensitivities& sensitivities, std::size_t base,
                                                      std::vector<Channel> channels, std::size_t blocks);

}  // namespace voussoir
