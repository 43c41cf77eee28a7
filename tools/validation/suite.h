#pragma once
/// @file All studies, and how they are run.

#include <optional>

#include "tools/validation/findings.h"

namespace voussoir::validation {

/// All studies, in the order of the report.
std::vector<Study> all_studies();

/// Those whose name contains one of the words (all, if there are none); `quick_only` leaves the long ones
/// out. Throws InputError naming the studies if a word fits none.
std::vector<Study> chosen_studies(const std::vector<std::string>& words, bool quick_only);

/// A study with what it found.
struct StudyResult {
  std::string name = {};
  std::string title = {};
  Findings findings = {};
  double seconds = 0.0;
  std::string failure = {};  ///< what was thrown; empty if nothing
};

/// Runs the studies, `threads` at a time; results in the studies' order. `finished` is called, one at a time,
/// as each study ends.
std::vector<StudyResult> run_studies(const std::vector<Study>& studies, int threads,
                                     const std::function<void(const StudyResult&)>& finished);

struct Tally {
  int cases = 0;  ///< with a tolerance
  int within = 0;
  int comparisons = 0;  ///< without
  int hard_cases = 0;
  int correct = 0;
  int failures = 0;  ///< studies that threw

  bool all_good() const { return within == cases && correct == hard_cases && failures == 0; }
};

Tally tally(const std::vector<StudyResult>& results);

}  // namespace voussoir::validation
