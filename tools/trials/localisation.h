#pragma once
/// @file How often the truth is found: the paper's Tables 2 and 3, calibration, false alarms. Seeds are
/// fixed.

#include <string>
#include <vector>

#include "lookup/lookup.h"
#include "tools/trials/paper_cases.h"

namespace voussoir {

/// How a ranking did over noisy trials.
struct Success {
  int trials = 0;
  int first = 0;        ///< truth at the head of the list
  int in_five = 0;      ///< truth among the first five
  int in_credible = 0;  ///< truth in the 95 % set (posterior only)
  double in_exact = 0;  ///< sum of held_by_exact_set (posterior only)
};

struct CaseResult {
  PaperCase paper_case;
  Success paper_objective;       ///< Eq. 1, exhaustive
  Success right_model;           ///< posterior, noise shape and level known
  Success default_model;         ///< posterior, nothing known of the noise
  int genetic_found = 0;         ///< trials in which the genetic search ends at the truth
  int genetic_minimum = 0;       ///< trials in which it reaches the exhaustive minimum of Eq. 1
  std::vector<int> generations;  ///< to convergence, of the trials that found the truth, sorted
};

/// The library's row of a scene such as "10,4", of which displacements are known. Throws InputError for a
/// scene that the bridge does not have, Failure if the library has it not or only its outcome.
std::size_t row_of(const Library& library, const std::string& scene);

/// The probabilities of the eligible scenes. With `noise` default-constructed nothing is known of the noise.
Posterior posterior_of(const Library& library, const Measurements& measured, const Eligible& eligible,
                       const NoiseModel& noise, const Prior& prior);

/// The place of the truth in the order of probabilities, from 0: scenes that are likelier come before it.
/// That of all rows if the truth is impossible.
std::size_t place_of(std::size_t truth, const Posterior& posterior);

/// The chance that a set of exactly 95 % of the probability holds the truth, which takes the least likely
/// scene of the credible set by lot, as often as it takes to hold no more. Scenes are whole, so a credible
/// set holds the truth more often than in 95 % even if all probabilities are right, and at least as often as
/// its first scene is the truth; this is 95 % on average then, and says whether they are.
double held_by_exact_set(std::size_t truth, const Posterior& posterior);

/// Counts where the truth comes in the order of probabilities and whether it is in the credible set.
void count_posterior(std::size_t truth, const Posterior& posterior, Success& success);

/// The five scenes that fit best by the paper's Eq. 1.
std::vector<ScoredRow> best_by_misfit(const Library& library, const Measurements& measured,
                                      const Eligible& eligible);

/// Counts where the truth comes among the best by misfit.
void count_misfit(std::size_t truth, const std::vector<ScoredRow>& best, Success& success);

/// Noisy readings of a case's scene, and each method's answer among the scenes with as many missing blocks.
CaseResult run_case(const Library& library, const PaperCase& paper_case, int trials, std::uint64_t seed);

/// One bin of a reliability table: scenes that were given a probability within it.
struct ReliabilityBin {
  std::size_t scenes = 0;
  double mean_probability = 0.0;
  double frequency = 0.0;       ///< share that was the truth
  double standard_error = 0.0;  ///< of the frequency, if the probabilities are right
};

/// Ten bins of equal width without scenes. Until finish_bins they hold sums: of probabilities, of truths and,
/// in the place of the standard error, of variances.
std::vector<ReliabilityBin> unfinished_bins();

/// Enters an answer's probabilities, but for very small ones.
void add_to_bins(const Posterior& posterior, std::size_t truth, std::vector<ReliabilityBin>& bins);

/// Adds finished bins to unfinished ones.
void add_finished(const std::vector<ReliabilityBin>& finished, std::vector<ReliabilityBin>& sum);

/// From sums to means. Precondition: the bins are unfinished.
void finish_bins(std::vector<ReliabilityBin>& bins);

struct Calibration {
  Success success;
  double mean_set_size = 0.0;  ///< scenes in the 95 % set
  std::vector<ReliabilityBin> bins;
};

/// Random scenes (numbers of missing blocks equally often) with noise levels even in 1..20 % and sensors that
/// fail as often as the lookup supposes, looked up among all scenes; `stated`: the noise level is told to the
/// lookup.
Calibration calibrate(const Library& library, NoiseShape drawn, NoiseShape assumed, bool stated, int trials,
                      std::uint64_t seed);

/// Trials with the intact bridge (uniform noise, levels even in 1..20 %) in which a damaged scene comes
/// first.
int false_alarms(const Library& library, bool known_noise, int trials, std::uint64_t seed);

}  // namespace voussoir
