#pragma once
/// @file What locate-damage answers, before it is put into words.

#include <memory>
#include <optional>
#include <vector>

#include "lookup/answer/fit.h"
#include "lookup/evidence/evidence.h"
#include "lookup/evidence/posterior.h"
#include "lookup/search/genetic_search.h"
#include "lookup/unknown/bridge_posterior.h"

namespace voussoir {

/// A scene that may explain the readings.
struct Candidate {
  std::size_t row = 0;
  Scene scene;
  Outcome outcome = Outcome::standing;     ///< in the bridge as its file states it
  std::optional<double> standing_share{};  ///< of a scene that falls there but may stand (UncertainFall)
  double misfit = 0.0;                     ///< Eq. 1
  std::optional<double> posterior;         ///< with Objective::posterior
  std::vector<Scene> same_readings;  ///< scenes that these sensors cannot tell from this one under this noise
};

/// What the readings say of a bridge that is not exactly known, beside the scenes.
struct BridgeAnswer {
  UnknownBridge model;  ///< of the readings
  BridgePosterior posterior;
};

struct Answer;

/// What the answer is without readings that may be wrong.
struct AnswerWithout {
  std::vector<std::size_t> channels;
  std::shared_ptr<const Answer> answer;
};

struct Answer {
  std::vector<Candidate> candidates;      ///< best first
  std::optional<Posterior> posterior;     ///< with Objective::posterior
  std::optional<NoiseEstimate> noise;     ///< if the best candidate is the truth; with Objective::posterior
  std::optional<Fit> fit;                 ///< of the likeliest scenes; with Objective::posterior
  std::vector<SensorResidual> residuals;  ///< against what the answer lets expect, for each reading
  std::optional<BridgeAnswer> bridge;     ///< unless the bridge counts as known, or no scene is possible
  std::optional<AnswerWithout> without;   ///< the readings that suspects_of names, if there are some
  bool known_bridge = true;               ///< counts_as_known
  bool contested = false;  ///< another database that may as well be right comes to another answer
  Prior prior;             ///< as it was used (stated_prior)
  std::size_t readings = 0;
  std::vector<std::size_t> counted;    ///< channels whose readings say something (Observation::reading)
  std::size_t searched = 0;            ///< scenes
  std::size_t unresolved = 0;          ///< scenes left out because the solver gave no answer
  std::size_t fallen = 0;              ///< and because they fall, so that there is nothing to read
  std::vector<GeneticResult> genetic;  ///< with Search::genetic: for each number of missing blocks but 0
};

}  // namespace voussoir
