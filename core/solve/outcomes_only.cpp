#include "core/solve/outcomes_only.h"

#include <algorithm>
#include <cmath>

namespace voussoir {
namespace {

constexpr double kFrequency = 68.0;  ///< of the reference bridge [rad/s], whose times settings have

constexpr double kShares = 1000.0;  ///< times are stated in these parts of the reference bridge's

void shorten(double share, DecisionRules& rules) {
  for (double* time :
       {&rules.earliest_decision, &rules.latest_decision, &rules.freer_from, &rules.freer_until})
    *time *= share;
}

}  // namespace

SolverSettings for_outcomes(SolverSettings settings, const Model& model) {
  if (has_mortar(model.parameters)) return settings;
  const double periods = kFrequency / DynamicSolver(model, settings.motion).frequency();
  const double share = std::min(1.0, std::ceil(kShares * periods) / kShares);
  settings.motion.ramp *= share;
  settings.motion.moment *= share;
  shorten(share, settings.motion.decision);
  shorten(share, settings.patient);
  settings.falls_nearby =
      settings.newton.skips.near_falls && settings.motion.integrator == Integrator::implicit_blocks;
  return settings;
}

}  // namespace voussoir
