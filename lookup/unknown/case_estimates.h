#pragma once
/// @file Estimates of the evidence of all scenes in all cases, each as good as it has to be.

#include <span>
#include <utility>
#include <vector>

#include "lookup/unknown/unknown_screen.h"

namespace voussoir {

/// Rows of a table are named by their places in a list.
class CaseEstimates {
 public:
  /// All of them outlive this. `beforehand`: log prior of each of the rows.
  /// Cases come in descending order of levels and conditions, those of one level side by side.
  CaseEstimates(const UnknownBridge& bridge, const Observation& observation, const SceneTable& table,
                std::span<const UnknownCase> cases, std::span<const std::size_t> rows,
                std::span<const double> beforehand);

  /// The numbers of the next level's cases, from the first to before the last.
  std::pair<std::size_t, std::size_t> next_level() const;

  /// Makes their screen; see UnknownScreen.
  void look_at_next(const Eigen::MatrixXd& pulls);

  /// So many cases have a screen.
  std::size_t looked_at() const { return peaks_.size(); }

  /// In the cases of the last screen, in the first directions and a few more, as far as log p(scene, readings
  /// | case) may be `least`.
  void estimate(std::span<const std::size_t> places, double least);

  /// In more directions, in all cases from number `from` on that have a screen, where estimates are `least`.
  void refine(std::span<const std::size_t> places, std::size_t from, ScreenDirections directions,
              double least);

  /// Over all cases. Of a row whose estimates were all below `least` the last time, the largest counts for
  /// each.
  const std::vector<double>& sums() const { return sums_; }

  /// Of one case, with what was known beforehand; infinity where the estimate failed, -infinity if the scene
  /// is impossible or the case has no screen.
  double of(std::size_t place, std::size_t number) const {
    return static_cast<double>(logs_[place * cases_.size() + number]) + beforehand_[place];
  }
  std::size_t count() const { return logs_.size(); }  ///< of estimates

  const Eigen::MatrixXd& rises() const { return rises_; }  ///< CasePruning::rise, of cases that have a screen

 private:
  std::vector<ScreenedRow> screened(std::span<const std::size_t> places, std::size_t first, double least);
  void add_up(std::span<const std::size_t> places, double least);
  static double sum_over_cases(std::span<const float> logs, double largest);
  void add_rises(std::size_t number);

  const UnknownBridge& bridge_;
  const Observation& observation_;
  const SceneTable& table_;
  std::span<const UnknownCase> cases_;
  std::span<const std::size_t> rows_;
  std::span<const double> beforehand_;
  std::vector<UnknownScreen> screens_;  // one for each level
  std::vector<ScatterLogs> peaks_;      // of each case: ReducedCase::peaks
  Eigen::MatrixXd rises_;
  std::vector<float> logs_;  // row by row of each case: log p(readings | scene, case)
  std::vector<double> sums_;
};

}  // namespace voussoir
