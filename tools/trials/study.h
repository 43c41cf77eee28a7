#pragma once
/// @file Trials on irregular bridges: which question is asked of which true bridges, and how it went.

#include <functional>
#include <string>
#include <vector>

#include "tools/trials/trial_series.h"

namespace voussoir {

/// True bridges with blocks missing, under a name.
struct DamagedTruth {
  std::string name;
  std::vector<TrueBridge> bridges;
};

/// True bridges at two times, nothing missing.
struct IntactTruth {
  std::string name;
  std::vector<IntactBridge> bridges;
};

struct StudySettings {
  std::vector<double> sigmas = {1e-5, 3e-5, 1e-4};  ///< [m]
  std::uint64_t seed = 1;                           ///< of the readings' errors
  std::size_t every = 1;                            ///< one of so many singles is looked for among singles
  Conditions conditions = Conditions::uncertain;    ///< as the lookup is told where the bridge is unknown
  std::size_t every_all = 10;                       ///< and among all scenes
  std::shared_ptr<const SampledBridges> sampled{};  ///< what the lookup takes for evidence of the scatter
  std::string load{};  ///< readings are of what this stage of a load case adds; empty: of the bridge's weight
};

/// In which ways readings are taken then.
std::vector<ReadingsTaken> all_taken(const StudySettings& settings);

/// One row of the tables.
struct StudyRow {
  std::string truth;
  std::string looked_for;  ///< "singles among singles", "singles among all", "pairs among pairs", "pairs
                           ///< among all", "intact"
  ReadingsTaken taken = ReadingsTaken::change;
  double sigma = 0.0;  ///< [m]
  bool known_bridge = false;
  TrialRates rates;
  double milliseconds = 0.0;  ///< a question, on one thread
};

using RowDone = std::function<void(const StudyRow&)>;

/// Singles among singles and among all scenes, pairs among pairs and among all: each as a change, with both
/// epochs and as absolute readings, or as what a load adds and how much more it adds, with the bridge known
/// and unknown.
std::vector<StudyRow> study_damaged(const Database& database, const DamagedTruth& truth,
                                    const StudySettings& settings, const RowDone& done);

/// Intact bridges among all scenes, in the same ways.
std::vector<StudyRow> study_intact(const Database& database, const IntactTruth& truth,
                                   const StudySettings& settings, const RowDone& done);

}  // namespace voussoir
