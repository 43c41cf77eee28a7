#include "lookup/checks/turned_readings.h"

#include <fmt/format.h>

#include <cmath>

namespace voussoir {
namespace {

// Beforehand that signs are wrong. Of readings that are right so much or more is asked with a chance of a
// thousandth at most, as what is likelier by r on average is 1 (Markov).
constexpr double kTurnedChance = 1e-3;
constexpr double kWellShown = 0.05;  // chance of the fit from which on nothing is asked

Observation turned_round(Observation observation) {
  for (std::size_t i = 0; i < observation.reading.size(); ++i) {
    const double twice = 2.0 * observation.origin[i];
    observation.reading[i] = twice - observation.reading[i];
    observation.displacement[i] = twice - observation.displacement[i];
  }
  return observation;
}

}  // namespace

std::optional<Fit> check_signs(const AskedReadings& asked, double chance) {
  if (!is_change(asked.comparison.kind) || chance >= kWellShown) return std::nullopt;
  const Library& library = asked.comparison.library;
  const SceneTable& table = library.table;
  const Observation readings = turned_round(asked.observation);
  const Posterior turned =
      posterior(table, asked.preparation.eligible(), asked.preparation.screen()(readings),
                asked.preparation.prior(), library.layout.size());
  if (turned.credible.empty() || turned.log_evidence + std::log(kTurnedChance) < asked.posterior.log_evidence)
    return std::nullopt;
  const std::span<const double> likeliest = table.row(turned.credible.front());
  if (!check_fit(readings, estimate_noise(readings, likeliest), likeliest).explained) return std::nullopt;
  return Fit{
      false, chance,
      fmt::format("with the opposite sign they would be far likelier ({}): are the two times taken for "
                  "each other?",
                  to_string(table.scene(turned.credible.front()), library.layout))};
}

}  // namespace voussoir
