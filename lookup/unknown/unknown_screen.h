#pragma once
/// @file Estimates of the evidence of many scenes of a bridge that is not exactly known, from a few
/// combinations of the readings, in cases that share them.
///
/// Readings are whitened by the intact bridge's covariance in one of the cases. Of all directions those in
/// which the readings are farthest from the intact bridge come first, one for each case, then that in which
/// they are farthest from the likeliest scene known so far, as all that are as likely leave much the same of
/// them; then those in which losses show most: the leading principal directions of what all losses change,
/// their signals and their scatter. In the first of them, as many as are worth it, the scene's Gaussian is
/// worked out, with what two blocks' signals have in common as far as kFirstColumns show it; the rest of each
/// counts once more for every other block. So a covariance is never less than the true one, and never loses
/// its positive sign: X Y^T + Y X^T lies between -(X X^T + Y Y^T) and X X^T + Y Y^T. What lies in no
/// direction counts as it does for the intact bridge: a loss can only widen it, so an estimate is rarely too
/// low. No choice of directions makes it so; it only makes estimates higher. So all cases can have the same
/// ones, and what losses change in them is worked out once.

#include <Eigen/Cholesky>
#include <array>
#include <span>
#include <vector>

#include "lookup/unknown/case_noise.h"
#include "lookup/unknown/reduced_density.h"

namespace voussoir {

/// Columns in the directions.
using DirectionColumns = Eigen::Matrix<double, static_cast<int>(kDirections), Eigen::Dynamic>;

/// A row of a table, what its log densities have to be to matter, and where they are kept.
struct ScreenedRow {
  std::size_t row;
  double least;
  float* logs;
};

class UnknownScreen {
 public:
  /// All but `pulls` outlive the screen. `cases` differ in conditions only.
  /// Columns of `pulls` are directions of their own, in rows of y (SceneLikelihoods::pull).
  UnknownScreen(const UnknownBridge& bridge, const Observation& observation, const SceneTable& table,
                std::span<const UnknownCase> cases, const Eigen::MatrixXd& pulls, int threads);

  /// log p(readings | scene, case) of rows of the table in the first directions, and in a few more where that
  /// matters; see estimate_log_densities.
  void estimate(std::span<const ScreenedRow> rows, const Eigen::MatrixXd& rises, std::size_t before) const;

  /// The same in more directions; see refine_log_densities. `logs` are those of the screen's cases.
  void refine(std::span<const ScreenedRow> rows, ScreenDirections directions) const;

  const std::vector<ReducedCase>& cases() const { return cases_; }

 private:
  void choose_directions(std::span<const Eigen::MatrixXd> others, const Eigen::MatrixXd& product,
                         const Eigen::MatrixXd& pulls);
  Eigen::MatrixXd reading_directions(std::span<const Eigen::MatrixXd> others, const Eigen::MatrixXd& product,
                                     const Eigen::MatrixXd& pulls,
                                     const Eigen::LLT<Eigen::MatrixXd>& white) const;
  void add_intact(const Eigen::MatrixXd& others, const Eigen::MatrixXd& bridge,
                  const Eigen::MatrixXd& reduced_bridge, ReducedCase& to) const;
  void reduce_losses(int threads);
  void reduce(const Loss& loss, ReducedLoss& to) const;
  DirectionColumns projected(const Eigen::MatrixXd& columns, const std::vector<double>& by_channel) const;
  Eigen::MatrixXd epoch_columns_of(std::span<const DirectionColumns> changes) const;
  void reduce_bridge(const LossFactors& factors, LossInDirections<double>& to) const;
  void reduce_epoch(const DirectionColumns& change, const DirectionColumns& first,
                    LossInDirections<double>& to) const;

  ScenePrediction scene(const ScreenedRow& row, const KnownLosses& known) const;
  template <class Work>
  void for_rows_together(std::span<const ScreenedRow> rows, Work work) const;
  ReducedQuestion question() const;

  const UnknownBridge& bridge_;
  const Observation& observation_;
  const SceneTable& table_;
  Eigen::MatrixXd directions_;       // rows of y x directions: T^T
  DirectionColumns epoch_after_;     // columns of E of the second epoch
  std::vector<ReducedLoss> losses_;  // of UnknownBridge::losses
  ReducedLoss none_;                 // of scenes without known losses
  std::vector<ReducedCase> cases_;
  // By channel, filled up for lanes; the directions as losses and, unless that is none, as the bridge count.
  std::vector<double> intact_, is_read_, directions_by_channel_, of_bridge_by_channel_;
  std::vector<float> rounded_directions_;
  DirectionVector reading_{};
  double least_variance_ = 0.0;  // CaseNoise
  DirectionTriangle points_{};   // what a unit variance at each changed point adds
  DirectionTriangle bridge_of_intact_{};
};

}  // namespace voussoir
