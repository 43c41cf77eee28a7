#pragma once
/// @file One question to the lookup whose right answer is known, and what many of them say of it.

#include <array>
#include <vector>

#include "lookup/answer/verdict.h"
#include "lookup/lookup.h"
#include "tools/trials/localisation.h"

namespace voussoir {

/// How the lookup is asked.
struct Asking {
  const Database& database;
  const SensorList& sensors;
  LookupSettings lookup;
  bool known_bridge = false;
  std::shared_ptr<const SampledBridges> sampled{};  ///< ComparisonSettings::sampled
};

/// How an answer stands to the truth.
struct Trial {
  std::size_t bridge = 0;    ///< that the readings come from
  bool first = false;        ///< no other scene is as likely as the truth
  bool in_credible = false;  ///< the truth is in the 95 % set
  double in_exact = 0.0;     ///< held_by_exact_set
  std::size_t set_size = 0;  ///< scenes in it
  double in_set = 0.0;       ///< probability that it holds: at least 95 %, as scenes are whole
  double likeliest = 0.0;    ///< probability of the likeliest scene
  double brier = 0.0;        ///< sum over all scenes of (probability - whether it is the truth)^2
  Verdict verdict = Verdict::cannot_tell;
  bool names_sound = false;          ///< the verdict is located, and a block that it names is there
  std::vector<ReliabilityBin> bins;  ///< of this trial's probabilities, unfinished
};

/// Asks and compares with the truth, a row of the database's nominal variant.
Trial ask(const Asking& asking, const ReadingsFile& readings, std::size_t truth);

inline constexpr std::size_t kVerdicts = 5;

/// All verdicts in their order.
std::array<Verdict, kVerdicts> all_verdicts();

/// Does it say that blocks are missing?
bool is_alarm(Verdict verdict);

/// A share of trials. Those of one bridge are not independent of each other, so the standard error is that
/// between bridges: sqrt(sum_b (k_b - n_b p)^2 B / (B - 1)) / N, k_b of n_b trials of bridge b counting.
struct Share {
  double value = 0.0;
  double standard_error = 0.0;
};

struct TrialRates {
  std::size_t trials = 0;
  std::size_t bridges = 0;
  Share first, in_credible;
  Share in_exact;        ///< 95 % if all probabilities are right
  Share wrong_and_sure;  ///< the likeliest scene is not the truth and has more than kCertain
  Share alarm;           ///< the verdict says that blocks are missing
  Share names_sound;     ///< it names a block that is there
  double mean_set_size = 0.0;
  double mean_in_set = 0.0;  ///< how often the sets hold the truth if all probabilities are right
  double mean_brier = 0.0;
  std::array<std::size_t, kVerdicts> verdicts{};  ///< how often each was given
  std::vector<ReliabilityBin> bins;
};

/// Precondition: at least one trial.
TrialRates rates_of(const std::vector<Trial>& trials);

}  // namespace voussoir
