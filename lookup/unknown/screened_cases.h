#pragma once
/// @file The evidence of all scenes over all cases of a bridge that is not exactly known, of which estimates
/// say which scenes, in which cases, are worth working out.

#include <functional>
#include <map>
#include <span>
#include <vector>

#include "lookup/evidence/scene_evidence.h"
#include "lookup/unknown/case_estimates.h"
#include "lookup/unknown/left_scenes.h"
#include "lookup/unknown/unknown_evidence.h"

namespace voussoir {

class ScreenedCases {
 public:
  /// `beforehand`: log prior of each of the rows. Cases come in descending order of levels and conditions.
  /// All of them outlive this.
  ScreenedCases(const UnknownBridge& bridge, const Observation& observation, const SceneTable& table,
                std::span<const UnknownCase> cases, std::span<const std::size_t> rows,
                std::span<const double> beforehand);

  /// log of the mean evidence over all cases of the rows that may count, by their places, in ascending order;
  /// -infinity for impossible ones. The `count` likeliest and all that matter are worked out; others count by
  /// their estimates, corrected by what those of their kind were off. These and those left out hold less than
  /// a thousandth of the probability, unless there are too many.
  std::vector<PlaceLog> evidence(std::size_t count);

  /// The case in which the likeliest scene is likeliest, once there is evidence.
  std::size_t likeliest() const { return likeliest_; }

 private:
  using WantedCase = std::function<bool(std::size_t place, std::size_t number)>;

  std::vector<std::size_t> nearest_singles() const;
  void look_at_cases();
  Eigen::MatrixXd pull_of_likeliest(std::size_t first, std::size_t end);
  void look_at_level();
  void try_case(std::size_t number);
  void look_at_many(std::size_t first);
  double least_counted() const;
  double sum_of(double probability) const;
  std::vector<std::size_t> that_matter(std::span<const std::size_t> places, double rest) const;
  std::vector<std::size_t> that_matter(double rest) const;  // of all
  std::vector<std::size_t> candidates(std::size_t count) const;
  std::vector<std::size_t> known_to_need_it() const;
  void refine_likely();
  void refine(std::span<const std::size_t> places);
  void refine_others(LeftScenes& left);
  LeftScenes left_scenes(std::size_t count) const;
  void work_out_likely(std::size_t count, LeftScenes& left);
  void check_estimate(std::size_t place, std::size_t number);
  void work_out(std::span<const std::size_t> places, const WantedCase& is_wanted,
                const Eigen::MatrixXd* rise = nullptr);
  void work_out_where_likely(std::span<const std::size_t> places);
  bool may_matter(std::size_t place, std::size_t number) const;
  double total(std::size_t place) const;

  const UnknownBridge& bridge_;
  const Observation& observation_;
  const SceneTable& table_;
  std::span<const std::size_t> rows_;
  std::span<const double> beforehand_;
  std::vector<std::size_t> few_, many_;  // places of rows with at most one missing block, and with more
  std::vector<CaseTerms> terms_;         // of each case
  CaseEstimates estimates_;
  SceneLikelihoods likelihoods_;
  double too_low_;  // by how much estimates of likely scenes were found to be too low at most
  std::map<std::size_t, std::vector<double>> exact_;  // by place, for each case; others are not worked out
  std::vector<bool> is_refined_;                      // in all directions
  std::vector<bool> is_worked_out_;                   // in all cases that may matter
  std::size_t likeliest_ = 0;
  double best_ = kImpossible;  // of any scene in any case, worked out
};

}  // namespace voussoir
