#pragma once
/// @file The evidence of the scenes that can matter: bounds of the search index's clusters, or estimates
/// where there are none, say which these are, and only they are worked out.

#include <optional>
#include <span>
#include <vector>

#include "database/records/database.h"
#include "database/search/search_index.h"
#include "lookup/evidence/gaussian_screen.h"
#include "lookup/evidence/posterior.h"
#include "lookup/readings/observation.h"

namespace voussoir {

/// What all left-out scenes together can hold of the probability.
inline constexpr double kScreenedAway = 1e-6;

class EvidenceScreen {
 public:
  /// Table, index (without clusters if there is none) and eligible rows must outlive the screen.
  EvidenceScreen(const SceneTable& table, const SearchIndex& index, const Eligible& eligible,
                 const Prior& prior);

  /// log_evidence_of_rows(..., eligible.rows), but -infinity for rows that hold less than a share of
  /// kScreenedAway of the posterior together; the `count` likeliest scenes are never left out.
  RowValues operator()(const Observation& observation, std::size_t count = 1) const;

 private:
  std::vector<std::size_t> rows_of(std::span<const std::size_t> clusters) const;
  std::vector<std::size_t> in_order(std::span<const std::size_t> rows) const;
  std::vector<std::size_t> nearest_clusters(const Observation& observation, std::size_t count) const;
  std::optional<double> least_that_matters(const Observation& observation, std::size_t count) const;
  std::vector<std::size_t> rows_within_bounds(const Observation& observation, std::size_t count) const;
  std::vector<std::size_t> likely_rows(const Observation& observation,
                                       std::span<const std::size_t> possible) const;
  RowValues in_order_of_estimates(const Observation& observation, std::size_t count) const;

  const SceneTable& table_;
  SearchIndex index_;
  const Eligible& eligible_;
  RowPriors priors_;
  GaussianScreen gaussian_;
};

}  // namespace voussoir
