#include "lookup/report/reading_words.h"

#include <fmt/format.h>

#include "core/text.h"

namespace voussoir {
namespace {

std::string_view quantity_in_words(Quantity quantity) {
  switch (quantity) {
    case Quantity::ux:
      return "horizontal displacement";
    case Quantity::tilt:
      return "tilt";
    case Quantity::distance:
      return "distance";
    default:
      return "vertical displacement";
  }
}

}  // namespace

std::string_view to_string(ReadingKind kind) {
  switch (kind) {
    case ReadingKind::change:
      return "change";
    case ReadingKind::load:
      return "load";
    case ReadingKind::load_change:
      return "load-change";
    default:
      return "absolute";
  }
}

std::string_view value_in_words(ReadingKind kind) {
  switch (kind) {
    case ReadingKind::change:
      return "change between two times";
    case ReadingKind::load:
      return "what a load adds";
    case ReadingKind::load_change:
      return "change of what a load adds";
    default:
      return "displacement";
  }
}

std::string axis_in_words(ReadingKind kind, Quantity quantity) {
  const std::string_view what = kind == ReadingKind::change        ? "change of "
                                : kind == ReadingKind::load        ? "added by the load: "
                                : kind == ReadingKind::load_change ? "more added by the load: "
                                                                   : "";
  return fmt::format("{}{} [{}]", what, quantity_in_words(quantity), unit_of(quantity));
}

std::vector<std::string> silent_sensors(const Comparison& comparison) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < comparison.measured.silent.size(); ++i)
    if (comparison.measured.silent[i]) names.push_back(name_without_load(comparison, i));
  const auto repeated = std::ranges::unique(names);  // under several loads
  names.erase(repeated.begin(), repeated.end());
  return names;
}

std::string readings_in_words(const Comparison& comparison, std::size_t readings) {
  const std::string_view what = comparison.library.storage != nullptr ? "rows"
                                : comparison.quantity.empty()         ? "control points"
                                                                      : "sensors";
  const std::size_t channels = comparison.library.points.size();
  const std::vector<std::string> silent = silent_sensors(comparison);
  std::string text = fmt::format("{} of {} {} have a reading", readings, channels, what);
  if (!silent.empty())
    text += fmt::format(", {} {} silent ({})", silent.size(), silent.size() == 1 ? "is" : "are",
                        names_in_words(silent));
  if (comparison.kind == ReadingKind::absolute) return text;
  return fmt::format(
      "{} ({}{})", text, value_in_words(comparison.kind),
      is_change(comparison.kind) ? ", the bridge at the first taken to be as the database has it" : "");
}

std::string history_in_words(const std::string& history) {
  if (history == kBuiltState) return history + " (missing blocks were never there)";
  if (history == kLostState) return history + " (missing blocks went while the bridge carried its weight)";
  return history;
}

std::string evidence_in_words(const Comparison& comparison) {
  if (!comparison.sampled) return "derivatives of the stored bridge (first order)";
  const SampledBridges& sampled = *comparison.sampled;
  return sampled.has_first_order
             ? fmt::format(
                   "derivatives of the stored bridge, and what they leave of {} sampled bridges that "
                   "were solved in full; temperature, supports and changes of joints by derivatives alone",
                   sampled.count)
             : fmt::format(
                   "{} sampled bridges that were solved in full, alone: what none of them shows counts "
                   "as exactly known",
                   sampled.count);
}

}  // namespace voussoir
