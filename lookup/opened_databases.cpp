#include "lookup/opened_databases.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "database/records/content_digest.h"
#include "lookup/answer/verdict.h"
#include "lookup/checks/fewer_readings.h"
#include "lookup/readings/sensors_file.h"
#include "lookup/readings/stated_sigmas.h"

namespace voussoir {
namespace {

/// The same assumptions must not count twice.
void require_another(const Database& database, const OpenedDatabases& opened) {
  for (const OpenedDatabase& one : opened)
    if (one.database.digest() == database.digest())
      throw InputError(fmt::format("{} and {} are the same database (digest {}), expected each once",
                                   one.database.path().string(), database.path().string(),
                                   database.digest().substr(0, kDigestShown)));
}

void open_database(const QuestionSettings& question, const std::filesystem::path& file,
                   OpenedDatabases& opened) {
  Database database = Database::open(file);
  require_another(database, opened);
  OpenedDatabase& one = opened.emplace_back(question, std::move(database));
  if (const auto& part = one.database.shard())
    throw Failure(fmt::format("{}: is part {} of a database, expected the whole: see merge-databases",
                              one.database.path().string(), to_string(part->shard)));
  one.sensors = all_sensors(one.database, question.sensors);
  one.sampled = sampled_bridges(one.database, question.evidence);
}

/// What was asked for and cannot have an effect on these readings is said: who tries other errors must not
/// believe the answer that does not change.
std::vector<std::string> notes_of(const ReadingsFile& file, const QuestionSettings& question) {
  const bool has_sigma = question.comparison.sigma.has_value();
  const NoiseModel& noise = question.lookup.noise;
  std::vector<std::string> notes;
  if (!question.without.empty()) notes.push_back(fmt::format("left out by --without: {}", question.without));
  const bool states_all = std::ranges::none_of(
      file.readings, [](const Reading& one) { return !one.silent && std::isnan(one.sigma); });
  if (has_sigma && states_all)
    notes.push_back("--sigma has no effect: every reading states its own error (sigma_mm)");
  if (noise.relative && (states_all || has_sigma))
    notes.push_back("--noise has no effect: the standard deviation of every reading is stated");
  if (noise.floor > 0.0 && (states_all || has_sigma))
    notes.push_back("--floor has no effect: the standard deviation of every reading is stated");
  const bool names_levellings =
      std::ranges::any_of(file.readings, [](const Reading& one) { return !one.levelling.empty(); });
  if (names_levellings && !question.lookup.nuisance.any())
    notes.push_back(
        "levellings are named, but the datum of each is taken as known: --unknown-datum 0.3mm and "
        "--unknown-tilt 0.03mm/m let each have its own");
  return notes;
}

/// Without the readings that are left out.
Comparison compared(const ReadingsFile& file, const OpenedDatabase& one) {
  ComparisonSettings settings = one.question.comparison;
  settings.sampled = one.sampled;
  Comparison all = compare(file, one.sensors, one.database, settings);
  if (one.question.without.empty()) return all;
  const std::vector<std::size_t> channels = channels_at(all, one.question.without);
  return without_readings(std::move(all), channels);
}

Answered ask_one(OpenedDatabase& one, const ReadingsText& readings) {
  const ReadingsFile file = parse_readings(readings.text, readings.name, one.sensors);
  Answered asked{.opened = &one,
                 .comparison = compared(file, one),
                 .settings = one.question.lookup,
                 .answer = {},
                 .notes = notes_of(file, one.question)};
  asked.settings.noise = noise_of(asked.comparison.measured, asked.settings.noise);
  asked.answer = one.preparations.ask(asked.comparison, asked.settings);
  return asked;
}

AskedDatabase summary_of(const Answered& asked) {
  const Database& database = asked.opened->database;
  const Posterior& posterior = *asked.answer.posterior;
  AskedDatabase summary{database.path().string(), database.bridge_name(), database.digest(),
                        verdict_of(asked.answer)};
  if (!posterior.credible.empty())
    summary.first =
        to_string(asked.comparison.library.table.scene(posterior.credible.front()), database.layout());
  summary.intact = intact_probability(posterior);
  summary.log_evidence = posterior.log_evidence;
  return summary;
}

void require_comparable(const std::vector<Answered>& all) {
  std::vector<DatabaseReadings> readings;
  for (const Answered& one : all) {
    const Database& database = one.opened->database;
    readings.push_back(
        database_readings(database.path().string(), database.control_points(), one.comparison, one.answer));
    if (one.answer.known_bridge != all.front().answer.known_bridge)
      throw InputError(fmt::format(
          "one of {} and {} is a database of a bridge that is exactly known, the other is not: expected both "
          "to be built alike, or --known-bridge",
          all.front().opened->database.path().string(), database.path().string()));
  }
  require_one_bridge(readings);
  require_same_readings(readings);
}

/// One of several: messages say which.
Answered ask_one_of_several(OpenedDatabase& one, const ReadingsText& readings) {
  try {
    return ask_one(one, readings);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{} (asked of {})", error.what(), one.database.path().string()));
  }
}

}  // namespace

OpenedDatabases open_databases(const QuestionSettings& question) {
  if (question.databases.size() > 1 && question.lookup.objective == Objective::paper)
    throw InputError("several databases are weighed by probabilities, expected --objective posterior");
  OpenedDatabases opened;
  for (const std::filesystem::path& file : question.databases) open_database(question, file, opened);
  return opened;
}

Answered ask(OpenedDatabases& opened, const ReadingsText& readings) {
  if (opened.size() == 1) return ask_one(opened.front(), readings);
  std::vector<Answered> all;
  for (OpenedDatabase& one : opened) all.push_back(ask_one_of_several(one, readings));
  require_comparable(all);
  std::vector<AskedDatabase> databases;
  for (const Answered& one : all) databases.push_back(summary_of(one));
  weigh(databases);
  const auto likeliest = std::ranges::max_element(
      all, {}, [](const Answered& one) { return one.answer.posterior->log_evidence; });
  likeliest->answer.contested = is_contested(databases);
  likeliest->answer.without.reset();  // it would have to be weighed among the databases anew
  likeliest->databases = std::move(databases);
  return std::move(*likeliest);
}

}  // namespace voussoir
