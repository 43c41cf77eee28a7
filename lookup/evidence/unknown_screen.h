#pragma once
/// @file Estimates of the evidence of many scenes of a bridge that is not exactly known, in one case, from a
/// few combinations of the readings.
///
/// Readings are whitened by the intact bridge's covariance. Of all directions the readings themselves come
/// first, then those in which losses show most: the leading principal directions of what all losses change,
/// their signals and their scatter. In kDirections of them the scene's Gaussian is worked out, with what two
/// blocks' signals have in common as far as kFirstColumns show it; the rest of each counts once more for
/// every other block. So a covariance is never less than the true one, and never loses its positive sign: X
/// Y^T + Y X^T lies between -(X X^T + Y Y^T) and X X^T + Y Y^T. What lies in no direction counts as it does
/// for the intact bridge: a loss can only widen it, so an estimate is rarely too low.

#include <array>
#include <limits>
#include <span>
#include <vector>

#include "core/simd/lanes.h"
#include "lookup/evidence/scatter_density.h"
#include "lookup/evidence/unknown_bridge.h"

namespace voussoir {

inline constexpr std::size_t kDirections = 16;
inline constexpr std::size_t kFirstDirections = 8;  ///< that pairs are looked at in first
inline constexpr std::size_t kEpochColumns = 4;     ///< combinations of an epoch's parameters, the leading

using DirectionVector = std::array<double, kDirections>;
using DirectionTriangle = std::array<double, lower_size(kDirections)>;

/// A loss in the directions.
struct ReducedLoss {
  DirectionVector signal{};
  std::array<double, kDirections* static_cast<std::size_t>(kFirstColumns)> first{};  ///< of A
  std::array<double, kDirections * kEpochColumns> epoch{};                           ///< of E
  /// What it adds to A A^T and to all else where a scene has one, two, three losses; of several without what
  /// the columns above add, which the losses share.
  std::array<DirectionTriangle, kMostLosses> bridge{}, others{};
  const double* signal_of_rows = nullptr;  ///< in rows of y
};

class UnknownScreen {
 public:
  /// In the bridge's case as it is now. All of them outlive the screen.
  UnknownScreen(const UnknownBridge& bridge, const Observation& observation, const SceneTable& table,
                int threads);

  /// log p(readings | scene) of these rows of the table, kappa marginalised; -infinity for impossible scenes,
  /// NaN where the estimate fails. Where it is below `least` of a row, it may be anything below.
  std::vector<double> estimates(std::span<const std::size_t> rows, std::span<const double> least) const;

  /// log density of readings that the intact bridge would show exactly, for each of kScatterFactors: the most
  /// that any scene can have that widens its covariance.
  const ScatterLogs& peaks() const { return peaks_; }

 private:
  void choose_directions(const Eigen::MatrixXd& reference);
  void choose_epoch_columns();
  ReducedLoss reduced(const Loss& loss) const;
  void reduce_bridge(const LossFactors& factors, ReducedLoss& to) const;
  void reduce_others(const LossFactors& factors, const Eigen::VectorXd& signal, ReducedLoss& to) const;

  const UnknownBridge& bridge_;
  const Observation& observation_;
  const SceneTable& table_;
  double spread_;
  int threads_;
  Eigen::MatrixXd directions_;           // rows of y x directions: T^T
  Eigen::MatrixXd of_loss_, of_bridge_;  // the same by channel, as losses and the bridge count
  Eigen::MatrixXd intact_epochs_;        // directions x columns of E
  Eigen::MatrixXd epoch_columns_;        // parameters of an epoch x kEpochColumns
  std::vector<ReducedLoss> losses_;      // of UnknownBridge::losses
  std::vector<double> nothing_;
  ReducedLoss none_;  // of scenes without known losses
  DirectionTriangle bridge_of_intact_{}, others_of_intact_{};
  DirectionTriangle points_{};  // what a unit variance at each changed point adds
  DirectionVector reading_{};
  // Logarithm of the density of what lies in no direction, and in none of kFirstDirections, by kappa.
  ScatterLogs offset_{}, offset_of_few_{}, peaks_{};
};

}  // namespace voussoir
