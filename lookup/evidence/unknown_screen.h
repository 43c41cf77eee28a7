#pragma once
/// @file Estimates of the evidence of many scenes of a bridge that is not exactly known, from a few
/// combinations of the readings, in cases that share them.
///
/// Readings are whitened by the intact bridge's covariance in one of the cases. Of all directions those in
/// which the readings are farthest from the intact bridge come first, one for each case, then those in which
/// losses show most: the leading principal directions of what all losses change, their signals and their
/// scatter. In the first of them, as many as are worth it, the scene's Gaussian is worked out, with what two
/// blocks' signals have in common as far as kFirstColumns show it; the rest of each counts once more for
/// every other block. So a covariance is never less than the true one, and never loses its positive sign: X
/// Y^T + Y X^T lies between -(X X^T + Y Y^T) and X X^T + Y Y^T. What lies in no direction counts as it does
/// for the intact bridge: a loss can only widen it, so an estimate is rarely too low. No choice of directions
/// makes it so; it only makes estimates higher. So all cases can have the same ones, and what losses change
/// in them is worked out once.

#include <Eigen/Cholesky>
#include <array>
#include <span>
#include <vector>

#include "lookup/evidence/reduced_density.h"

namespace voussoir {

class UnknownScreen {
 public:
  /// All of them outlive the screen; the bridge's case is changed. `cases` differ in conditions only.
  UnknownScreen(UnknownBridge& bridge, const Observation& observation, const SceneTable& table,
                std::span<const UnknownCase> cases, int threads);

  /// log p(readings | scene, case) of a row of the table in the first few directions; see
  /// estimate_log_densities. NaN where the estimate fails.
  void estimate(std::size_t row, double least, const Eigen::MatrixXd& rises, std::span<double> logs) const;

  /// The same in more directions; see refine_log_densities. `logs` are those of the screen's cases.
  void refine(std::size_t row, ScreenDirections directions, double least, std::span<double> logs) const;

  const std::vector<ReducedCase>& cases() const { return cases_; }

 private:
  void choose_directions(std::span<const Eigen::MatrixXd> others, const Eigen::MatrixXd& product);
  Eigen::MatrixXd reading_directions(std::span<const Eigen::MatrixXd> others, const Eigen::MatrixXd& product,
                                     const Eigen::LLT<Eigen::MatrixXd>& white) const;
  void choose_epoch_columns();
  ReducedLoss reduced(const Loss& loss) const;
  void add_intact(const Eigen::MatrixXd& others, const Eigen::MatrixXd& bridge, ReducedCase& to) const;
  void reduce_bridge(const LossFactors& factors, ReducedLoss& to) const;
  void reduce_epoch(const LossFactors& factors, ReducedLoss& to) const;

  /// A scene's losses in the directions; that of nothing if there are none.
  struct Lost {
    std::array<const ReducedLoss*, kMostLosses> losses{};
    std::size_t count = 1;
  };
  Lost lost(std::size_t row) const;
  ReducedQuestion question() const;

  const UnknownBridge& bridge_;
  const Observation& observation_;
  const SceneTable& table_;
  Eigen::MatrixXd directions_;           // rows of y x directions: T^T
  Eigen::MatrixXd of_loss_, of_bridge_;  // the same by channel, as losses and the bridge count
  Eigen::MatrixXd epoch_after_;          // directions x columns of E of the second epoch
  Eigen::MatrixXd epoch_columns_;        // parameters of an epoch x kEpochColumns
  std::vector<ReducedLoss> losses_;      // of UnknownBridge::losses
  ReducedLoss none_;                     // of scenes without known losses
  std::vector<double> nothing_;
  std::vector<ReducedCase> cases_;
  // What question() refers to.
  std::vector<std::size_t> channels_;
  std::vector<double> after_;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> directions_by_row_;
  DirectionVector reading_{};
  DirectionTriangle points_{};  // what a unit variance at each changed point adds
  DirectionTriangle bridge_of_intact_{};
};

}  // namespace voussoir
