#pragma once
/// @file The evidence of all scenes over all cases of a bridge that is not exactly known, of which estimates
/// say which scenes, in which cases, are worth working out.

#include <functional>
#include <span>
#include <vector>

#include "lookup/evidence/unknown_evidence.h"
#include "lookup/evidence/unknown_screen.h"

namespace voussoir {

class ScreenedCases {
 public:
  /// `beforehand`: log prior of each of the rows. Cases come in descending order of levels and conditions.
  /// All of them outlive this; the bridge's case is changed.
  ScreenedCases(UnknownBridge& bridge, const Observation& observation, const SceneTable& table,
                std::span<const UnknownCase> cases, std::span<const std::size_t> rows,
                std::span<const double> beforehand);

  /// log of the mean evidence over all cases, for each of the rows. -infinity for impossible ones. The
  /// `count` likeliest and all that matter are worked out; the others, which hold less than a thousandth of
  /// the probability unless there are too many, count by their estimates.
  std::vector<double> evidence(std::size_t count);

  /// The case in which the likeliest scene is likeliest, once there is evidence.
  std::size_t likeliest() const { return likeliest_; }

 private:
  using WantedCase = std::function<bool(std::size_t place, std::size_t number)>;

  struct Case {
    UnknownCase one;
    CaseTerms terms;
    std::vector<double> estimate{};  ///< of each row, with what was known beforehand
    ScatterLogs peaks{};             ///< UnknownScreen::peaks
  };

  std::vector<std::size_t> nearest_singles() const;
  void estimate(const UnknownScreen& screen, std::span<const std::size_t> places, double least,
                std::vector<double>& estimates) const;
  std::vector<std::size_t> not_ruled_out(Case& one, double least) const;
  void look_at(Case& one);
  void look_at_cases();
  std::vector<std::size_t> first_of(std::vector<std::size_t> places, std::span<const double> estimates,
                                    std::size_t count) const;
  std::vector<std::size_t> most_likely(std::size_t count) const;
  double work_out_likely(std::size_t count);
  Eigen::MatrixXd rises() const;
  void check_estimate(std::size_t place, std::size_t number);
  void work_out(std::span<const std::size_t> places, const WantedCase& is_wanted,
                const Eigen::MatrixXd* rise = nullptr);
  void work_out_where_likely(std::span<const std::size_t> places);
  double total(std::size_t place) const;
  double shift_of(std::span<const std::size_t> places) const;

  UnknownBridge& bridge_;
  const Observation& observation_;
  const SceneTable& table_;
  std::span<const std::size_t> rows_;
  std::span<const double> beforehand_;
  std::vector<std::size_t> few_, many_;  // places of rows with at most one missing block, and with more
  std::vector<Case> cases_;              // those that widen another's covariance before it
  std::vector<double> estimate_;         // of each row over all cases, the same
  SceneLikelihoods likelihoods_;
  double too_low_;  // by how much estimates of likely scenes were found to be too low at most
  std::vector<std::vector<double>> exact_;  // of each row, for each case; empty: not worked out
  Eigen::MatrixXd rise_;                    // CasePruning::rise, once all cases were looked at
  std::vector<bool> is_worked_out_;         // in all cases that may matter
  std::size_t likeliest_ = 0;
  double best_ = -std::numeric_limits<double>::infinity();  // of any scene in any case, worked out
};

}  // namespace voussoir
