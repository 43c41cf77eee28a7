#pragma once
/// @file Estimates of the evidence of many scenes of a bridge that is not exactly known, in one case, from a
/// few combinations of the readings.
///
/// Readings are whitened by the intact bridge's covariance. Of all directions the readings themselves come
/// first, then those in which losses show most: the leading principal directions of what all losses change,
/// their signals and their scatter. In kDirections of them the scene's Gaussian is worked out, with what two
/// blocks' signals have in common as far as kFirstColumns show it. What lies in no direction counts as it
/// does for the intact bridge: a loss can only widen it, so an estimate is rarely too low.

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

using DirectionVector = std::array<double, kDirections>;
using DirectionTriangle = std::array<double, lower_size(kDirections)>;

/// A loss in the directions.
struct ReducedLoss {
  DirectionVector signal{};
  std::array<double, kDirections* static_cast<std::size_t>(kFirstColumns)> first{};  ///< of A
  DirectionTriangle bridge{};              ///< what it adds to A A^T
  DirectionTriangle others{};              ///< and to all else
  const double* signal_of_rows = nullptr;  ///< in rows of y
  bool known = false;
};

class UnknownScreen {
 public:
  /// In the bridge's case as it is now. All of them outlive the screen.
  UnknownScreen(const UnknownBridge& bridge, const Observation& observation, const SceneTable& table,
                int threads);

  /// log p(readings | scene) of these rows of the table, kappa marginalised; -infinity for impossible scenes,
  /// NaN where the estimate fails. Where it is below `least` of a row, it may be anything below.
  std::vector<double> estimates(std::span<const std::size_t> rows, std::span<const double> least) const;

 private:
  void choose_directions(const Eigen::MatrixXd& reference);
  ReducedLoss reduced(const Loss& loss) const;

  const UnknownBridge& bridge_;
  const Observation& observation_;
  const SceneTable& table_;
  double spread_;
  int threads_;
  Eigen::MatrixXd directions_;           // rows of y x directions: T^T
  Eigen::MatrixXd of_loss_, of_bridge_;  // the same by channel, as losses and the bridge count
  Eigen::MatrixXd intact_first_;         // directions x kFirstColumns
  Eigen::MatrixXd intact_epochs_;        // directions x columns of E
  std::vector<ReducedLoss> losses_;      // of UnknownBridge::losses
  std::vector<double> nothing_;
  ReducedLoss none_;  // of scenes with fewer known losses
  DirectionTriangle bridge_of_intact_{}, others_of_intact_{};
  DirectionTriangle points_{};  // what a unit variance at each changed point adds
  DirectionVector reading_{};
  // Logarithm of the density of what lies in no direction, and in none of kFirstDirections, by kappa.
  ScatterLogs offset_{}, offset_of_few_{};
};

}  // namespace voussoir
