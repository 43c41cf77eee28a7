#pragma once
/// @file The posterior, screened: bounds in single precision, of the search index's clusters first and then
/// of rows, say which scenes can matter, and only these are worked out.

#include <span>
#include <vector>

#include "database/records/database.h"
#include "database/search/search_index.h"
#include "lookup/evidence/posterior.h"
#include "lookup/readings/measurements.h"
#include "lookup/readings/noise_model.h"

namespace voussoir {

/// What all left-out scenes together can hold of the probability.
inline constexpr double kScreenedAway = 1e-6;

class PosteriorScreen {
 public:
  /// Table, index and eligible rows must outlive the screen.
  PosteriorScreen(const SceneTable& table, const SearchIndex& index, const Eligible& eligible,
                  const Prior& prior, std::size_t block_count);

  /// posterior(log_evidence_of_rows(...)) but for a share of kScreenedAway; the `count` likeliest scenes are
  /// never left out. `intact` as there. Where the bounds do not apply (Student noise, own sigmas, a model
  /// error, an absolute part beside an unknown level) nothing is left out.
  Posterior operator()(const Measurements& measurements, std::span<const double> intact,
                       const NoiseModel& noise, std::size_t count = 1) const;

  /// The rows that can matter, in ascending order; what operator() works out.
  std::vector<std::size_t> rows_that_matter(const Measurements& measurements, std::span<const double> intact,
                                            const NoiseModel& noise, std::size_t count = 1) const;

 private:
  struct Problem;
  std::vector<std::size_t> rows_of(std::span<const std::size_t> clusters) const;
  std::vector<float> with_prior(std::vector<float> of_clusters) const;
  std::vector<float> row_bounds(const Problem& problem, std::span<const std::size_t> rows) const;
  double least_that_matters(const Problem& problem, std::size_t count) const;
  std::vector<double> exact_evidence(const Problem& problem, std::span<const std::size_t> rows) const;

  const SceneTable& table_;
  SearchIndex index_;
  const Eligible& eligible_;
  Prior prior_;
  std::size_t block_count_;
  std::vector<float> log_prior_;  // of each row of the table; -infinity for those that are not eligible
  std::vector<float> cluster_log_prior_;  // the largest of each cluster's rows
};

}  // namespace voussoir
