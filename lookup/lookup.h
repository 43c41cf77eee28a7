#pragma once
/// @file From measurements to an answer: the flow of locate-damage.

#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "lookup/evidence/evidence.h"
#include "lookup/evidence/evidence_screen.h"
#include "lookup/evidence/posterior.h"
#include "lookup/fit.h"
#include "lookup/readings/comparison.h"
#include "lookup/readings/noise_model.h"
#include "lookup/readings/nuisance.h"
#include "lookup/search/genetic_search.h"
#include "lookup/search/indexed_search.h"
#include "lookup/unknown/unknown_question.h"

namespace voussoir {

enum class Objective {
  posterior,  ///< probability given the readings, the noise model and the prior
  paper       ///< Eq. 1
};
enum class Search { exhaustive, genetic, nearest };

struct LookupSettings {
  Objective objective = Objective::posterior;
  Search search = Search::exhaustive;
  Prior prior;
  NoiseModel noise;
  Nuisance nuisance;
  bool known_bridge = false;       ///< what the comparison says of the bridge's uncertainty does not count
  Epochs epochs = Epochs::change;  ///< this and the next: if the bridge is not known
  Conditions conditions = Conditions::uncertain;
  std::size_t top = 10;  ///< candidates wanted
  GeneticSettings genetic{};
};

/// A scene that may explain the readings.
struct Candidate {
  std::size_t row = 0;
  Scene scene;
  Outcome outcome = Outcome::standing;
  double misfit = 0.0;               ///< Eq. 1
  std::optional<double> posterior;   ///< with Objective::posterior
  std::vector<Scene> same_readings;  ///< scenes that these sensors cannot tell from this one under this noise
};

/// What the readings say of a bridge that is not exactly known, beside the scenes.
struct BridgeAnswer {
  UnknownBridge model;  ///< of the readings
  BridgePosterior posterior;
};

struct Answer {
  std::vector<Candidate> candidates;      ///< best first
  std::optional<Posterior> posterior;     ///< with Objective::posterior
  std::optional<NoiseEstimate> noise;     ///< if the best candidate is the truth; with Objective::posterior
  std::optional<Fit> fit;                 ///< of the best candidate; with Objective::posterior
  std::vector<SensorResidual> residuals;  ///< of the best candidate, a value for each reading
  std::optional<BridgeAnswer> bridge;     ///< unless the bridge counts as known, or no scene is possible
  bool known_bridge = true;               ///< counts_as_known
  bool contested = false;  ///< another database that may as well be right comes to another answer
  Prior prior;             ///< as it was used (stated_prior)
  std::size_t readings = 0;
  std::vector<std::size_t> counted;    ///< channels whose readings say something (Observation::reading)
  std::size_t searched = 0;            ///< scenes
  std::size_t unresolved = 0;          ///< scenes left out because the solver gave no answer
  std::vector<GeneticResult> genetic;  ///< with Search::genetic: for each number of missing blocks but 0
};

/// True if the answer is one for a bridge that is exactly as the model says: it is wanted so, nothing is
/// known of the uncertainty of these readings, or only misfits are asked for.
bool counts_as_known(const Comparison& comparison, const LookupSettings& settings);

/// What does not depend on the readings: made once for all questions to one library.
class Preparation {
 public:
  /// `known`: counts_as_known. What the library looks into outlives this. Throws Failure if it has no scene
  /// with the wanted numbers of missing blocks, InputError for a prior that leaves none possible.
  Preparation(const Library& library, const LookupSettings& settings, bool known);
  Preparation(const Preparation&) = delete;  // its parts look into each other
  Preparation& operator=(const Preparation&) = delete;

  const Prior& prior() const { return prior_; }
  const Eligible& eligible() const { return eligible_; }
  const EvidenceScreen& screen() const;
  std::vector<ScoredRow> smallest_misfits(const Observation& observation, std::size_t count) const;

 private:
  SceneTable table_;
  std::vector<StoredPoint> points_;
  Prior prior_;
  Eligible eligible_;
  SearchIndex index_;  // without clusters if there is none
  // Made when they are first needed.
  mutable std::mutex making_;
  mutable std::optional<EvidenceScreen> screen_;
  mutable std::optional<IndexedSearch> indexed_;
};

/// Scores the scenes of the library and ranks the best. The preparation is of the comparison's library (or of
/// an equal one) and these settings. Throws InputError if no reading can tell scenes apart, and for all but
/// changes under known conditions where sampled bridges are all that is known of the bridge's scatter.
Answer locate_damage(const Comparison& comparison, const LookupSettings& settings,
                     const Preparation& preparation);

/// The same of a single question. Throws as Preparation, too.
Answer locate_damage(const Comparison& comparison, const LookupSettings& settings);

}  // namespace voussoir
