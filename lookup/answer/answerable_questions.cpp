#include "lookup/answer/answerable_questions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace voussoir {
namespace {

/// Sampled bridges show the directions that they took, and nothing of temperature and supports: only what
/// changes is small against its errors in all others.
void require_known_scatter(const Comparison& comparison, const LookupSettings& settings) {
  if (!comparison.sampled || comparison.sampled->has_first_order) return;
  constexpr const char* kRemedy = "or a database with sensitivities (build-database without --known-bridge)";
  if (settings.conditions == Conditions::uncertain)
    throw InputError(
        fmt::format("evidence from variants: this database says nothing of temperature and "
                    "supports, expected --conditions known, {}",
                    kRemedy));
  if (!is_change(comparison.kind) || settings.epochs == Epochs::both)
    throw InputError(
        fmt::format("evidence from variants: {} sampled bridges leave out most of what an "
                    "intact bridge can be, expected changes (--epochs change), {}",
                    comparison.sampled->count, kRemedy));
}

/// Where nothing changed a share of the change is an error of zero, and any scatter would be damage.
void require_stated_errors(const Comparison& comparison, const Observation& observation) {
  if (!is_change(comparison.kind) || !observation.unknown_level) return;
  const std::vector<std::size_t> channels = observation.channels_read();
  const auto without =
      std::ranges::find_if_not(channels, [&](std::size_t i) { return observation.floor[i] > 0.0; });
  if (without == channels.end()) return;
  throw InputError(fmt::format(
      "a change without an error (at {}), expected a column sigma_mm or --sigma 0.02mm: a share of what "
      "has not changed is none",
      comparison.library.points[*without].name));
}

/// The first of two epochs teaches what a bridge is like that is not exactly known.
void require_two_epochs(const Comparison& comparison, bool known) {
  if (comparison.before.empty())
    throw InputError("both epochs are to count, expected readings with before_mm and after_mm");
  for (std::size_t i = 0; i < comparison.before.size(); ++i)
    if (std::abs(comparison.before[i]) > kLargestDisplacement)
      throw InputError(
          fmt::format("both epochs are to count, expected displacements since the bridge carried nothing, "
                      "{} was at {:.6g} m before: heights above a datum show changes only",
                      comparison.library.points[i].name, comparison.before[i]));
  if (known)
    throw InputError(
        "both epochs are to count, expected a bridge that is not exactly known: a database with "
        "sensitivities, without --known-bridge");
}

}  // namespace

void require_answerable(const Comparison& comparison, const LookupSettings& settings,
                        const Observation& observation) {
  const bool known = counts_as_known(comparison, settings);
  if (settings.epochs == Epochs::both) require_two_epochs(comparison, known);
  if (!known) require_known_scatter(comparison, settings);
  if (settings.objective == Objective::posterior) require_stated_errors(comparison, observation);
}

}  // namespace voussoir
