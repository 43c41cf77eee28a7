#include "lookup/report/report.h"

#include <fmt/format.h>

#include "lookup/answer/verdict.h"
#include "lookup/readings/csv_text.h"
#include "lookup/report/words.h"

namespace voussoir {

std::string report(const Answer& answer, const LookupSettings& settings, const Comparison& comparison,
                   const Source& source, ReportFormat format) {
  switch (format) {
    case ReportFormat::json:
      return json_report(answer, settings, comparison, source);
    case ReportFormat::csv:
      return csv_report(answer, comparison.library);
    default:
      return text_report(answer, comparison, source);
  }
}

std::string csv_report(const Answer& answer, const Library& library) {
  std::string text = "rank,scene,misfit,posterior,outcome,place,verdict\n";
  const std::string_view verdict = answer.posterior ? to_string(verdict_of(answer)) : std::string_view();
  int rank = 0;
  for (const Candidate& candidate : answer.candidates)
    text += fmt::format(
        "{},{},{},{},{},{},{}\n", ++rank, csv_field(to_string(candidate.scene, library.layout)),
        candidate.misfit, candidate.posterior ? fmt::format("{}", *candidate.posterior) : "",
        to_string(candidate.outcome), csv_field(place_in_words(candidate.scene, library.layout)), verdict);
  return text;
}

std::string_view to_string(Conditions conditions) {
  return conditions == Conditions::known ? "known" : "uncertain";
}

std::string_view to_string(Epochs epochs) {
  return epochs == Epochs::both ? "both" : "change";
}

std::string_view to_string(Objective objective) {
  return objective == Objective::paper ? "paper" : "posterior";
}

std::string_view to_string(Search search) {
  return search == Search::genetic ? "genetic" : search == Search::nearest ? "nearest" : "exhaustive";
}

}  // namespace voussoir
