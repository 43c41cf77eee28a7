#pragma once
/// @file Estimates of the evidence of many scenes of a bridge that is not exactly known, from a few
/// combinations of the readings.
///
/// Readings are whitened by the intact bridge's covariance. Of all directions the readings themselves come
/// first and then, one by one, the block's signal that is farthest from all directions before; kDirections of
/// them are kept. In these the scene's Gaussian is worked out for one kappa at a time, with what two blocks'
/// signals have in common as far as kFirstColumns show it. What lies in no direction counts as the same for
/// all scenes.

#include <array>
#include <vector>

#include "core/simd/lanes.h"
#include "lookup/evidence/scatter_density.h"
#include "lookup/evidence/unknown_bridge.h"

namespace voussoir {

inline constexpr std::size_t kDirections = 16;

class UnknownScreen {
 public:
  /// All of them outlive the screen.
  UnknownScreen(const UnknownBridge& bridge, const Observation& observation, const SceneTable& table,
                double kappa, int threads);

  /// log p(readings | scene, kappa) but for a constant that is the same for all kappa, of these rows of the
  /// table; -infinity for impossible scenes, NaN where the estimate fails.
  std::vector<double> estimates(std::span<const std::size_t> rows) const;

  /// A loss in the directions.
  struct ReducedLoss {
    std::array<double, kDirections> signal{};
    std::array<double, kDirections* static_cast<std::size_t>(kFirstColumns)> first{};  ///< of A
    std::array<double, lower_size(kDirections)> rest{};  ///< what it adds to the covariance otherwise
    const double* signal_of_rows = nullptr;              ///< in rows of y
  };

 private:
  void choose_directions(const Eigen::LLT<Eigen::MatrixXd>& reference);
  ReducedLoss reduced(const Loss& loss) const;

  const UnknownBridge& bridge_;
  const Observation& observation_;
  const SceneTable& table_;
  double kappa_;
  double offset_ = 0.0;  // logarithm of the density that whitening takes out
  int threads_;
  Eigen::MatrixXd directions_;           // rows of y x kDirections: T^T
  Eigen::MatrixXd of_loss_, of_bridge_;  // the same by channel, as losses and the bridge count
  Eigen::MatrixXd intact_epochs_;        // directions x columns of E
  std::vector<ReducedLoss> losses_;      // of UnknownBridge::losses
  std::vector<double> nothing_;
  ReducedLoss none_;                                      // of scenes with fewer known losses
  std::array<double, lower_size(kDirections)> points_{};  // what a unit variance at each changed point adds
  std::array<double, kDirections> reading_{};
  std::array<double, kDirections* static_cast<std::size_t>(kFirstColumns)> intact_first_{};
};

}  // namespace voussoir
