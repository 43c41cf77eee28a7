#pragma once
/// @file A question about a bridge that is not exactly known: the evidence of every scene, then what the
/// readings say of the bridge.

#include <optional>
#include <span>
#include <vector>

#include "lookup/evidence/posterior.h"
#include "lookup/unknown/bridge_posterior.h"
#include "lookup/unknown/intact_gaussian.h"

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

struct UnknownEvidence {
  RowValues logs;         ///< log p(readings | scene) of the table's rows
  UnknownCase likeliest;  ///< the case in which the likeliest scene is likeliest
};

class UnknownBridgeQuestion {
 public:
  /// All of them outlive the question. The comparison has factors; the
  /// observation Gaussian noise (gaussian_noise). Throws InputError if no reading is at a point that can
  /// move.
  UnknownBridgeQuestion(const Comparison& comparison, const Observation& observation,
                        const UnknownSettings& settings);

  /// What is not known is marginalised: the parameters of bridge and epochs, their scatter, the noise's
  /// level, whether conditions changed. -infinity for rows that are impossible or not eligible. The `count`
  /// likeliest and all that matter are worked out, the others estimated (ScreenedCases).
  UnknownEvidence evidence(const Eligible& eligible, const Prior& prior, std::size_t count) const;

  /// What each of these rows would have in the sum that Posterior::log_evidence is the logarithm of, if all
  /// this were so: its logarithm.
  std::vector<double> log_parts_of(std::span<const std::size_t> rows, const Eligible& eligible,
                                   const Prior& prior, const Supposition& supposed) const;

  /// In the cases of one level of the noise.
  std::vector<IntactGaussian> gaussians_at(double level) const;

  /// Of these scenes, over all cases.
  BridgePosterior posterior(const std::vector<WeightedScene>& scenes) const;

  const UnknownBridge& bridge() const { return bridge_; }

 private:
  const Comparison& comparison_;
  const Observation& observation_;
  std::vector<UnknownCase> cases_;
  UnknownBridge bridge_;
};

/// The noise as the evidence of an unknown bridge counts it: of any shape a Gaussian of its variance, as all
/// else that is unknown is Gaussian.
NoiseModel gaussian_noise(NoiseModel noise);

}  // namespace voussoir
