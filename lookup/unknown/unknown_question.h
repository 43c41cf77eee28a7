#pragma once
/// @file A question about a bridge that is not exactly known: the evidence of every scene, then what the
/// readings say of the bridge.

#include <optional>
#include <span>
#include <vector>

#include "lookup/evidence/posterior.h"
#include "lookup/unknown/bridge_posterior.h"
#include "lookup/unknown/hidden_losses.h"
#include "lookup/unknown/line_errors.h"
#include "lookup/unknown/unstated_loads.h"

namespace voussoir {

/// A reading that is off by far more than its instrument's error.
struct GrossError {
  std::size_t channel = 0;
  double size = 0.0;  ///< [m] its standard deviation
};

/// What may be supposed of readings beside what is stated.
struct Supposition {
  double errors = 1.0;  ///< all instruments are off by so many times what is stated
  std::vector<GrossError> gross{};
  Eigen::MatrixXd beside{};    ///< [m2] in rows of y, covariance of what else acts; empty: nothing
  bool shown_exactly = false;  ///< what scenes show beyond losses with factors is just what the database has
};

class UnknownBridgeQuestion {
 public:
  /// All of them outlive the question. The comparison has factors; the
  /// observation Gaussian noise (gaussian_noise). Throws InputError if no reading is at a point that can
  /// move.
  UnknownBridgeQuestion(const Comparison& comparison, const Observation& observation,
                        const UnknownSettings& settings);

  /// log p(readings | scene) of the table's rows, what is not known marginalised: the parameters of bridge
  /// and epochs, their scatter, the noise's level, whether conditions changed. -infinity for rows that are
  /// impossible or not eligible. The `count` likeliest and all that matter are worked out, the others
  /// estimated (ScreenedCases).
  RowValues log_evidence(const Eligible& eligible, const Prior& prior, std::size_t count);

  /// What each of these rows would have in the sum that Posterior::log_evidence is the logarithm of, if all
  /// this were so: its logarithm.
  std::vector<double> log_parts_of(std::span<const std::size_t> rows, const Eligible& eligible,
                                   const Prior& prior, const Supposition& supposed) const;

  /// These at the likeliest level of the noise.
  std::vector<HiddenLoss> hidden_losses(const Eligible& eligible);
  std::vector<UnstatedLoad> unstated_loads(std::size_t count);
  std::vector<LineError> line_errors(std::size_t count);
  CauseChances chances(const UnstatedCause& cause) const;

  /// Of these scenes, over all cases.
  BridgePosterior posterior(const std::vector<WeightedScene>& scenes) const;

  const UnknownBridge& bridge() const { return bridge_; }
  CaseNoise noise() const;                                   ///< in the likeliest case
  double level() const { return cases_[likeliest_].level; }  ///< [-] of the noise: stated, or the likeliest

 private:
  const std::vector<IntactGaussian>& gaussians_of_level();

  const Comparison& comparison_;
  const Observation& observation_;
  std::vector<UnknownCase> cases_;
  UnknownBridge bridge_;
  std::size_t likeliest_ = 0;
  std::vector<IntactGaussian> gaussians_;  // of the likeliest level, once they are needed
};

/// The noise as the evidence of an unknown bridge counts it: of any shape a Gaussian of its variance, as all
/// else that is unknown is Gaussian.
NoiseModel gaussian_noise(NoiseModel noise);

}  // namespace voussoir
