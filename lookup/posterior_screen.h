#pragma once
/// @file The posterior, screened: a first pass in single precision bounds the evidence of every scene from
/// above, and only scenes that can matter are worked out.

#include <span>
#include <vector>

#include "database/database.h"
#include "lookup/float_statistics.h"
#include "lookup/measurements.h"
#include "lookup/noise_model.h"
#include "lookup/posterior.h"

namespace voussoir {

/// What all left-out scenes together can hold of the probability.
inline constexpr double kScreenedAway = 1e-9;

class PosteriorScreen {
 public:
  /// Table and eligible rows must outlive the screen.
  PosteriorScreen(const SceneTable& table, const Eligible& eligible, const Prior& prior,
                  std::size_t block_count);

  /// Keeps a copy of the eligible rows in single precision, which pays from a few measurements on.
  void keep_copy();

  /// posterior(log_evidence_of_rows(...)) but for a share of kScreenedAway; the `count` likeliest scenes are
  /// never left out. `intact` as there. Where the bounds do not apply (Student noise, own sigmas, a model
  /// error, an absolute part beside an unknown level) nothing is left out.
  Posterior operator()(const Measurements& measurements, std::span<const double> intact,
                       const NoiseModel& noise, std::size_t count = 1) const;

  /// The rows that can matter; what operator() works out.
  std::vector<std::size_t> rows_that_matter(const Measurements& measurements, std::span<const double> intact,
                                            const NoiseModel& noise, std::size_t count = 1) const;

 private:
  double least_that_matters(const std::vector<float>& bounds, std::size_t count,
                            const Measurements& measurements, std::span<const double> intact,
                            const NoiseModel& noise) const;
  std::vector<double> exact_evidence(const Measurements& measurements, std::span<const std::size_t> rows,
                                     std::span<const double> intact, const NoiseModel& noise) const;

  FloatStatistics statistics(const Observation& observation) const;

  const SceneTable& table_;
  const Eligible& eligible_;
  Prior prior_;
  std::size_t block_count_;
  std::size_t stride_;            // floats in a row of `vertical_`
  std::vector<float> vertical_;   // empty, or eligible rows x stride [m], NaN behind the last point
  std::vector<float> log_prior_;  // of each eligible row
};

}  // namespace voussoir
