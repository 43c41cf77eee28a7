#include <cmath>
#include <nlohmann/json.hpp>

#include "core/json_text.h"
#include "lookup/answer/verdict.h"
#include "lookup/readings/shown_readings.h"
#include "lookup/report/bridge_report.h"
#include "lookup/report/reading_words.h"
#include "lookup/report/report.h"
#include "lookup/report/report_words.h"
#include "lookup/report/words.h"

namespace voussoir {
namespace {

using nlohmann::ordered_json;

ordered_json candidate_json(const Candidate& candidate, const BlockLayout& layout) {
  ordered_json same = ordered_json::array();
  for (const Scene& scene : candidate.same_readings) same.push_back(to_string(scene, layout));
  ordered_json result = {{"scene", to_string(candidate.scene, layout)},
                         {"misfit", candidate.misfit},
                         {"posterior", nullptr},
                         {"outcome", to_string(candidate.outcome)},
                         {"standing_share", nullptr},
                         {"place", place_in_words(candidate.scene, layout)},
                         {"indistinguishable", std::move(same)}};
  if (candidate.posterior) result["posterior"] = *candidate.posterior;
  if (candidate.standing_share) result["standing_share"] = *candidate.standing_share;
  return result;
}

ordered_json settings_json(const LookupSettings& settings, const Prior& prior) {
  ordered_json result = {{"objective", to_string(settings.objective)},
                         {"search", to_string(settings.search)},
                         {"missing", prior.missing},
                         {"prior", weights_of(prior)},
                         {"top", settings.top}};
  if (settings.search == Search::genetic)
    result["genetic"] = {{"population", settings.genetic.population},
                         {"crossover", settings.genetic.crossover},
                         {"mutation", settings.genetic.mutation},
                         {"generations", settings.genetic.most_generations},
                         {"seed", settings.genetic.seed}};
  if (settings.objective == Objective::paper) return result;
  result["epochs"] = to_string(settings.epochs);
  result["conditions"] = to_string(settings.conditions);
  ordered_json noise = {{"model", to_string(settings.noise.shape)},
                        {"relative", nullptr},
                        {"floor_m", settings.noise.floor},
                        {"silent_sensors", settings.noise.silence}};
  if (settings.noise.relative) noise["relative"] = *settings.noise.relative;
  if (settings.noise.shape == NoiseShape::student)
    noise["degrees_of_freedom"] = settings.noise.degrees_of_freedom;
  result["noise"] = std::move(noise);
  result["unknown"] = {{"scale", settings.nuisance.scale},
                       {"datum_m", settings.nuisance.datum},
                       {"tilt_m_per_m", settings.nuisance.tilt}};
  return result;
}

ordered_json posterior_json(const Answer& answer, const Library& library) {
  constexpr double kWorthNaming = 1e-6;
  const Posterior& posterior = *answer.posterior;
  ordered_json blocks = ordered_json::array();
  for (std::size_t id = 0; id < posterior.block_probability.size(); ++id)
    if (posterior.block_probability[id] >= kWorthNaming)
      blocks.push_back(
          {{"block", library.layout.blocks[id].label}, {"probability", posterior.block_probability[id]}});
  ordered_json credible = ordered_json::array();
  for (const std::size_t row : posterior.credible)
    credible.push_back(to_string(library.table.scene(row), library.layout));
  return {{"missing_blocks", posterior.missing_probability},
          {"blocks", std::move(blocks)},
          {"credible_share", kCredibleShare},
          {"credible_set", std::move(credible)}};
}

ordered_json sensors_json(const Answer& answer, const Comparison& comparison) {
  const ShownReadings shown = shown_readings(comparison, answer.candidates.front().row);
  const std::vector<double> origin = origin_of(comparison);
  ordered_json result = ordered_json::array();
  for (const SensorResidual& sensor : answer.residuals) {
    ordered_json entry = {{"point", comparison.library.points[sensor.point].name},
                          {"unit", quantity_of(comparison, sensor.point) == Quantity::tilt ? "rad" : "m"}};
    if (!comparison.before.empty()) {
      entry["before_m"] = comparison.before[sensor.point];
      entry["after_m"] = comparison.after[sensor.point];
    }
    entry.update({{"reading_m", shown.reading[sensor.point]},
                  {"predicted_m", shown.expected[sensor.point]},
                  {"expected_m", sensor.predicted - origin[sensor.point]},
                  {"standardised_residual", sensor.error},
                  {"disagrees", sensor.disagrees}});
    result.push_back(std::move(entry));
  }
  return result;
}

/// What the readings are, what they were compared with, and the answer in one word.
void add_judgement(const Answer& answer, const Comparison& comparison, ordered_json& result) {
  result["history"] = comparison.history;
  result["known_bridge"] = answer.known_bridge;
  result["model_error"] = {{"share", comparison.model_error.share},
                           {"common", comparison.model_error.common}};
  result["intact_probability"] = nullptr;
  result["verdict"] = nullptr;
  if (!answer.posterior) return;
  result["intact_probability"] = intact_probability(*answer.posterior);
  result["intact_if_even"] = answer.posterior->intact_if_even;
  result["open_losses"] = ordered_json::array();
  for (const OpenLoss& loss : open_losses(answer))
    result["open_losses"].push_back(
        {{"scene", to_string(comparison.library.table.scene(loss.row), comparison.library.layout)},
         {"times_as_likely", loss.times_as_likely}});
  result["verdict"] = to_string(verdict_of(answer));
}

/// What each database says of the readings, and how likely its assumptions are.
ordered_json databases_json(const std::vector<AskedDatabase>& databases) {
  ordered_json result = ordered_json::array();
  for (const AskedDatabase& asked : databases)
    result.push_back({{"file", asked.file},
                      {"bridge", asked.bridge},
                      {"digest", asked.digest},
                      {"probability", asked.probability},
                      {"log_evidence", asked.log_evidence},
                      {"verdict", to_string(asked.verdict)},
                      {"first_scene", asked.first},
                      {"intact_probability", asked.intact}});
  return result;
}

/// The answer without readings that may be wrong, null if none is suspected.
ordered_json without_json(const Answer& answer, const Comparison& comparison) {
  if (!answer.without) return nullptr;
  const Answer& other = *answer.without->answer;
  ordered_json named = ordered_json::array();
  for (const BlockId block : named_blocks(other)) named.push_back(comparison.library.layout[block].label);
  return {{"sensors", suspects_in_words(answer, comparison)},
          {"verdict", to_string(verdict_of(other))},
          {"named", std::move(named)},
          {"intact_probability", intact_probability(*other.posterior)},
          {"open_losses", open_losses(other).size()},
          {"reason", other.fit->reason}};
}

constexpr std::size_t kMostJoints = 50;

ordered_json parameter_json(const KnownParameter& parameter) {
  return {{"name", parameter.name},
          {"unit", parameter.unit},
          {"before", {{"mean", 0.0}, {"deviation", parameter.deviation_before}}},
          {"after", {{"mean", parameter.mean}, {"deviation", parameter.deviation}}}};
}

/// What says how much bridges scatter.
ordered_json evidence_json(const Comparison& comparison) {
  const SampledBridges* const sampled = comparison.sampled.get();
  if (!sampled) return {{"from", "first-order"}};
  return {
      {"from", "variants"}, {"bridges", sampled->count}, {"beside_first_order", sampled->has_first_order}};
}

/// What moved the sensors, and what the readings say of the bridge and of temperature and supports.
ordered_json bridge_json(const BridgeAnswer& bridge, const Comparison& comparison) {
  const ReadingFactors& factors = *comparison.factors;
  ordered_json causes = ordered_json::array(), scatter = ordered_json::array(),
               parameters = ordered_json::array(), epochs = ordered_json::array();
  for (const Cause& cause : causes_of(bridge, factors))
    causes.push_back({{"cause", cause.name}, {"share", cause.share}, {"rms_m", cause.size}});
  for (std::size_t k = 0; k < kScatterFactors.size(); ++k)
    scatter.push_back(
        {{"deviation_factor", std::sqrt(kScatterFactors[k])}, {"probability", bridge.posterior.scatter[k]}});
  for (const KnownParameter& parameter : known_of_bridge(bridge, factors, kMostJoints))
    parameters.push_back(parameter_json(parameter));
  for (const KnownParameter& parameter : known_of_epochs(bridge, factors))
    epochs.push_back(parameter_json(parameter));
  return {{"evidence", evidence_json(comparison)},
          {"causes", std::move(causes)},
          {"scatter", std::move(scatter)},
          {"parameters", std::move(parameters)},
          {"epochs", std::move(epochs)}};
}

ordered_json measurements_json(const Answer& answer, const Comparison& comparison, const Source& source) {
  return {{"file", source.measurements},
          {"readings", answer.readings},
          {"silent", silent_sensors(comparison)},
          {"kind", to_string(comparison.kind)}};
}

ordered_json database_json(const Answer& answer, const Source& source) {
  return {{"file", source.database},
          {"bridge", source.bridge},
          {"digest", source.digest},
          {"stands_by_slip", source.stands_by_slip},
          {"scenes_searched", answer.searched},
          {"scenes_unresolved", answer.unresolved},
          {"scenes_fallen", answer.fallen}};
}

}  // namespace

std::string json_report(const Answer& answer, const LookupSettings& settings, const Comparison& comparison,
                        const Source& source) {
  const Library& library = comparison.library;
  ordered_json candidates = ordered_json::array();
  for (const Candidate& candidate : answer.candidates)
    candidates.push_back(candidate_json(candidate, library.layout));
  ordered_json result = {{"candidates", std::move(candidates)},
                         {"first_candidate", nullptr},
                         {"settings", settings_json(settings, answer.prior)},
                         {"measurements", measurements_json(answer, comparison, source)},
                         {"database", database_json(answer, source)}};
  result["notes"] = source.notes;
  if (!source.databases.empty()) result["databases"] = databases_json(source.databases);
  if (!answer.candidates.empty()) result["first_candidate"] = first_candidate_in_words(answer);
  add_judgement(answer, comparison, result);
  if (answer.posterior) result["posterior"] = posterior_json(answer, library);
  if (answer.noise)
    result["noise"] = {{"model", to_string(answer.noise->shape)},
                       {"relative", answer.noise->level},
                       {"estimated", answer.noise->estimated}};
  if (answer.fit)
    result["fit"] = {
        {"explained", answer.fit->explained}, {"chance", answer.fit->chance}, {"reason", answer.fit->reason}};
  result["without"] = without_json(answer, comparison);
  if (answer.bridge) result["bridge"] = bridge_json(*answer.bridge, comparison);
  if (!answer.residuals.empty()) result["sensors"] = sensors_json(answer, comparison);
  for (const GeneticResult& run : answer.genetic)
    result["genetic"].push_back({{"generations", run.generations},
                                 {"converged_in_generation", run.converged},
                                 {"evaluations", run.evaluations}});
  return json_text(result, 2);
}

}  // namespace voussoir
