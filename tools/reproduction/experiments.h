#pragma once
/// @file What is counted over noisy trials. Seeds are fixed; answers do not depend on the number of threads.

#include <vector>

#include "tools/reproduction/subject.h"
#include "tools/trials/localisation.h"

namespace voussoir {

/// The cases of Tables 2 and 3, each over the settings' trials.
std::vector<CaseResult> run_cases(const Subject& subject, const std::vector<PaperCase>& cases);

/// Runs of the genetic search for the example's scene at one noise level.
struct GenerationsAtNoise {
  double noise = 0.0;
  int seeds = 0;
  std::vector<int> generations{};  ///< to convergence, of the seeds that end at the truth, sorted
};

/// Fig. 7: noise from 0 to 20 %.
std::vector<GenerationsAtNoise> generations_against_noise(const Subject& subject);

/// How often random standing scenes are found at one noise level, among all scenes with as many missing
/// blocks.
struct OperatingPoint {
  double noise = 0.0;
  Success misfit;   ///< the paper's Eq. 1
  Success known;    ///< posterior, the noise's shape and level known
  Success unknown;  ///< posterior, nothing known of the noise
};

/// Noise from 0 to 20 %, for one or two missing blocks; the same scenes at every level.
std::vector<OperatingPoint> operating_curve(const Subject& subject, int missing);

/// Noise of the comparisons below [-].
inline constexpr double kComparedNoise = 0.05;

/// How often the blocks of one course of the wall are found, one missing at a time.
struct CourseSuccess {
  int course = 0;
  Success misfit, known;
};
std::vector<CourseSuccess> success_by_course(const Subject& subject);

/// How often random pairs are found, with and without an arch block among the two.
struct PairSuccess {
  Success misfit, known;
  int arch_block_found = 0;  ///< trials in which the best pair by Eq. 1 holds the truth's arch block
};
PairSuccess success_of_pairs(const Subject& subject, bool with_arch_block);

}  // namespace voussoir
