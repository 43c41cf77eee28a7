#pragma once
/// @file The evidence of the scenes that can matter: bounds in single precision, of the search index's
/// clusters first and then of rows, say which these are, and only they are worked out.

#include <span>
#include <vector>

#include "database/records/database.h"
#include "database/search/search_index.h"
#include "lookup/evidence/posterior.h"
#include "lookup/readings/observation.h"

namespace voussoir {

/// What all left-out scenes together can hold of the probability.
inline constexpr double kScreenedAway = 1e-6;

class EvidenceScreen {
 public:
  /// Table, index and eligible rows must outlive the screen.
  EvidenceScreen(const SceneTable& table, const SearchIndex& index, const Eligible& eligible,
                 const Prior& prior);

  /// log_evidence_of_rows(..., eligible.rows), but -infinity for rows that hold less than a share of
  /// kScreenedAway of the posterior together; the `count` likeliest scenes are never left out. Where the
  /// bounds do not apply (Student noise, own sigmas, a model error, an absolute part beside an unknown level)
  /// nothing is left out.
  std::vector<double> operator()(const Observation& observation, std::size_t count = 1) const;

  /// The rows that can matter, in ascending order; what operator() works out.
  std::vector<std::size_t> rows_that_matter(const Observation& observation, std::size_t count = 1) const;

 private:
  std::vector<std::size_t> rows_of(std::span<const std::size_t> clusters) const;
  std::vector<float> with_prior(std::vector<float> of_clusters) const;
  std::vector<float> row_bounds(const Observation& observation, const ErrorScales& scales,
                                std::span<const std::size_t> rows) const;
  double least_that_matters(const Observation& observation, std::size_t count) const;
  std::vector<double> exact_evidence(const Observation& observation, std::span<const std::size_t> rows) const;

  const SceneTable& table_;
  SearchIndex index_;
  const Eligible& eligible_;
  std::vector<float> log_prior_;  // of each row of the table; -infinity for those that are not eligible
  std::vector<float> cluster_log_prior_;  // the largest of each cluster's rows
};

}  // namespace voussoir
