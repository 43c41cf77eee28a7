#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "core/units.h"
#include "lookup/answer/verdict.h"
#include "lookup/report/bridge_report.h"
#include "lookup/report/drawing/page.h"
#include "lookup/report/reading_words.h"
#include "lookup/report/report.h"
#include "lookup/report/report_pictures.h"
#include "lookup/report/report_profiles.h"
#include "lookup/report/report_words.h"
#include "lookup/report/words.h"

namespace voussoir {
namespace {

constexpr std::size_t kMostJointsShown = 12;

using Terms = std::vector<std::pair<std::string, std::string>>;

/// What its bar is coloured by.
std::string verdict_class(const Answer& answer) {
  return answer.posterior ? fmt::format("verdict {}", to_string(verdict_of(answer))) : "verdict";
}

std::string verdict_html(const Answer& answer, const Comparison& comparison) {
  const Library& library = comparison.library;
  std::string html;
  if (const std::string first = headline(answer, comparison); !first.empty())
    html += paragraph(first, "lead");
  if (const std::string other = without_in_words(answer, comparison); !other.empty())
    html += paragraph(other, "lead");
  for (const std::string& sentence : conclusions_in_words(answer, library))
    html += paragraph(sentence, html.empty() ? "lead" : "");
  if (answer.posterior) html += paragraph("Verdict: " + verdict_in_words(answer));
  if (answer.posterior && !answer.posterior->credible.empty())
    html += paragraph(
        fmt::format("Number of missing blocks{}: {}. {:.0f} % of the probability is held by {} scene{}.",
                    if_true(answer), missing_in_words(answer), 100.0 * kCredibleShare,
                    answer.posterior->credible.size(), answer.posterior->credible.size() == 1 ? "" : "s"));
  if (const std::string same = same_in_words(answer.candidates.front(), library); !same.empty())
    html += paragraph("These sensors cannot tell it from: " + same);
  for (const std::string& sensor : odd_sensors(answer, comparison)) html += paragraph(sensor);
  return fmt::format("<div class=\"{}\">{}</div>\n", verdict_class(answer), html);
}

/// Blanks at which no line breaks.
std::string on_one_line(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == ' ' ? std::string("\u00a0") : std::string(1, c);
  return result;
}

Figure candidates_figure(const Answer& answer, const Library& library) {
  Table table{{"rank", "scene", "probability", "misfit", "behind the first", "outcome", "where"},
              {},
              {0, kAsNeeded, kAsNeeded, 4}};
  for (std::size_t i = 0; i < answer.candidates.size(); ++i) {
    const Candidate& candidate = answer.candidates[i];
    table.rows.push_back({static_cast<double>(i + 1), to_string(candidate.scene, library.layout),
                          candidate.posterior ? percent(*candidate.posterior) : "none asked for",
                          candidate.misfit,
                          i == 0 ? "" : on_one_line(behind(candidate, answer.candidates.front())),
                          std::string(candidate.standing_share ? "may stand" : to_string(candidate.outcome)),
                          place_in_words(candidate.scene, library.layout)});
  }
  return {
      "candidates",
      answer.posterior && !has_probabilities(answer) ? "The closest scenes, none of which is an answer"
                                                     : "Scenes that may explain the readings",
      "A scene is a set of missing blocks, named (course, position from the left); course 0 is the arch. The "
      "misfit is the logarithm of the summed differences in metres: smaller fits better.",
      "",
      table,
      true,
      TableView::open,
      5};
}

Figure causes_figure(const Answer& answer, const ReadingFactors& factors) {
  Table table{{"cause", "share of the squares [%]", "root mean square [mm]"}, {}, {kAsNeeded, 1, 3}};
  for (const Cause& cause : causes_of(*answer.bridge, factors))
    table.rows.push_back({cause.name, 100.0 * cause.share, kMillimetres * cause.size});
  return {"causes",
          "What moved the sensors",
          "As far as the answer believes in it, averaged over the likeliest scenes. Shares sum up to 100 %; "
          "parts "
          "that work against each other can have negative ones.",
          "",
          table,
          false,
          TableView::open,
          3};
}

Figure parameters_figure(const Answer& answer, const ReadingFactors& factors) {
  std::vector<KnownParameter> parameters = known_of_bridge(*answer.bridge, factors, kMostJointsShown);
  for (const KnownParameter& parameter : known_of_epochs(*answer.bridge, factors))
    parameters.push_back(parameter);
  Table table{{"parameter", "before", "after"}, {}};
  for (const KnownParameter& one : parameters)
    table.rows.push_back({one.name, before_in_words(one), after_in_words(one)});
  return {"parameters",
          "What the readings say of the bridge",
          "By how much it differs from what the bridge file states, one standard deviation to each side. "
          "What the "
          "whole bridge shares, the joints that the readings move farthest, then those of the time of the "
          "readings: "
          "temperature, supports and joints.",
          "",
          table,
          false,
          TableView::open,
          3};
}

/// Each set's readings with its residuals beside them.
std::vector<Figure> reading_figures(const PicturedAnswer& pictures) {
  const std::vector<Figure> residuals = residual_figures(pictures);
  std::vector<Figure> figures;
  for (const Figure& profile : profile_figures(pictures)) {
    figures.push_back(profile);
    const std::string id = "residual" + profile.id.substr(profile.id.find('-'));
    const auto beside = std::ranges::find(residuals, id, &Figure::id);
    if (beside != residuals.end()) figures.push_back(*beside);
  }
  return figures;
}

std::string bridge_html(const Answer& answer, const Comparison& comparison) {
  if (!answer.bridge || !has_probabilities(answer)) return "";
  return section_html("causes-and-bridge", "Other causes, and the bridge itself",
                      figures_html({causes_figure(answer, *comparison.factors),
                                    parameters_figure(answer, *comparison.factors)}));
}

std::string level_in_words(const NoiseModel& noise, ReadingKind kind) {
  if (noise.relative == 0.0) return "nothing relative to the reading";
  return noise.relative ? fmt::format("{:.3g} % of the {}, as stated", 100.0 * *noise.relative,
                                      errors_are_shares_of(kind))
                        : "unknown; all levels are weighed";
}

std::string unknowns_in_words(const Nuisance& nuisance) {
  if (!nuisance.any()) return "";
  return fmt::format("scale of all displacements {:.3g} %, datum {:.3g} mm, tilt {:.3g} mm per m",
                     100.0 * nuisance.scale, kMillimetres * nuisance.datum, kMillimetres * nuisance.tilt);
}

void add_noise_terms(const Answer& answer, const LookupSettings& settings, const Comparison& comparison,
                     Terms& terms) {
  terms.emplace_back("Noise model", std::string(to_string(settings.noise.shape)));
  terms.emplace_back("Noise level", level_in_words(settings.noise, comparison.kind));
  if (answer.noise)
    terms.emplace_back("Noise, if the first scene is the truth", noise_in_words(*answer.noise, comparison));
  if (settings.noise.floor > 0.0)
    terms.emplace_back("Absolute part of the noise",
                       fmt::format("{:.3g} mm", kMillimetres * settings.noise.floor));
  terms.emplace_back("Sensors that fail by themselves",
                     fmt::format("{:.3g} %", 100.0 * settings.noise.silence));
  if (settings.nuisance.any()) terms.emplace_back("Also unknown", unknowns_in_words(settings.nuisance));
}

std::string weights_in_words(const Prior& prior) {
  const std::vector<double> weight = weights_of(prior);
  std::string text;
  for (std::size_t i = 0; i < prior.missing.size(); ++i)
    text += fmt::format("{}{} (weight {:g})", i == 0 ? "" : ", ", prior.missing[i], weight[i]);
  return text;
}

std::string search_in_words(const LookupSettings& settings) {
  if (settings.search != Search::genetic) return std::string(to_string(settings.search));
  const GeneticSettings& genetic = settings.genetic;
  return fmt::format("genetic (population {}, crossover {:g}, mutation {:g}, {} generations, seed {})",
                     genetic.population, genetic.crossover, genetic.mutation, genetic.most_generations,
                     genetic.seed);
}

std::string assumptions_html(const Answer& answer, const LookupSettings& settings,
                             const Comparison& comparison, const Source& source) {
  std::string bridge = bridge_in_words(answer);
  if (!answer.known_bridge) bridge += "; bridges scatter by half to twice that";
  if (source.stands_by_slip) bridge += fmt::format("; {}", kStandsBySlip);
  Terms terms = {
      {"Bridge", std::move(bridge)},
      {"Measurements",
       fmt::format("{}: {}", source.measurements, readings_in_words(comparison, answer.readings))},
      {"History", history_in_words(comparison.history)},
      {"Database", fmt::format("{} (bridge '{}')", source.database, source.bridge)},
      {"Database digest", source.digest},
      {"Searched", searched_in_words(answer)},
      {"Objective", settings.objective == Objective::paper
                        ? "the misfit log(sum |measured - scene|) alone, which gives no probabilities"
                        : "posterior probability of each scene"},
      {"Search", search_in_words(settings)},
      {"Numbers of missing blocks considered", weights_in_words(answer.prior)},
      {"The model's own error",
       fmt::format("{:.2g} % of the change that a scene makes at a point, and {:.2g} % of "
                   "that change's root mean square",
                   100.0 * comparison.model_error.share, 100.0 * comparison.model_error.common)}};
  for (const std::string& note : source.notes) terms.emplace_back("Note", note);
  for (const AskedDatabase& asked : source.databases)
    terms.emplace_back("Database asked, and how likely its assumptions are", in_words(asked));
  if (answer.bridge) terms.emplace_back("How much bridges scatter", evidence_in_words(comparison));
  if (settings.objective == Objective::posterior) add_noise_terms(answer, settings, comparison, terms);
  return terms_html(terms) +
         paragraph(
             "Probabilities hold under these assumptions. What the model of the bridge leaves out is counted "
             "only through the allowance for the model's error.",
             "muted");
}

}  // namespace

std::string picture_report(const Answer& answer, const Comparison& comparison) {
  if (answer.candidates.empty())
    throw Failure("no scene explains the measurements: there is no picture to draw, only a page");
  return svg_file(draw_bridge(PicturedAnswer(answer, comparison)));
}

std::string page_report(const Answer& answer, const LookupSettings& settings, const Comparison& comparison,
                        const Source& source) {
  const Library& library = comparison.library;
  const std::string assumed =
      section_html("assumed", "What was assumed", assumptions_html(answer, settings, comparison, source));
  const std::string title = fmt::format("Search for missing blocks of bridge '{}'", source.bridge);
  if (answer.candidates.empty())
    return html_page(title,
                     paragraph("No scene in this database explains these measurements: every scene lacks a "
                               "block that has a reading.",
                               "lead") +
                         assumed);
  const PicturedAnswer pictures(answer, comparison);
  return html_page(
      title, verdict_html(answer, comparison) + figures_html({bridge_figure(pictures)}) +
                 section_html("ranked", "Candidates", figures_html({candidates_figure(answer, library)})) +
                 section_html("readings", "Readings and what was expected",
                              figures_html(reading_figures(pictures))) +
                 bridge_html(answer, comparison) + assumed);
}

}  // namespace voussoir
