#pragma once
/// @file What a question is asked with.

#include "lookup/evidence/posterior.h"
#include "lookup/readings/comparison.h"
#include "lookup/readings/noise_model.h"
#include "lookup/readings/nuisance.h"
#include "lookup/search/genetic_search.h"
#include "lookup/unknown/unknown_bridge.h"

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

/// True if the answer is one for a bridge that is exactly as the model says: it is wanted so, nothing is
/// known of the uncertainty of these readings, or only misfits are asked for.
inline bool counts_as_known(const Comparison& comparison, const LookupSettings& settings) {
  return settings.known_bridge || comparison.factors == nullptr || settings.objective == Objective::paper;
}

}  // namespace voussoir
