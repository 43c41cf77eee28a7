#include "lookup/locate_damage_desks.h"

#include <algorithm>

#include "core/error.h"
#include "lookup/command_line.h"
#include "lookup/readings/sensors_file.h"
#include "lookup/readings/stated_sigmas.h"
#include "lookup/report/report_words.h"
#include "lookup/report/words.h"
#include "lookup/weighed_databases.h"

namespace voussoir {
namespace {

SensorList sensors_of(const Database& database, const LocateDamageOptions& options) {
  SensorList list = control_point_sensors(database.control_points());
  if (options.sensors) read_sensors(*options.sensors, database.layout(), database.mesh(), list);
  return list;
}

/// The same assumptions must not count twice.
void require_another(const Database& database, const Desks& desks) {
  for (const Desk& desk : desks)
    if (desk.database.digest() == database.digest())
      throw InputError(fmt::format("{} and {} are the same database (digest {}), expected each once",
                                   desk.database.path().string(), database.path().string(),
                                   database.digest().substr(0, kDigestShown)));
}

void open_desk(const LocateDamageOptions& options, const std::optional<std::string>& named, Desks& desks) {
  Database database = Database::open(find_database(named));
  require_another(database, desks);
  Desk& desk = desks.emplace_back(options, finish(options), std::move(database));
  if (const auto& part = desk.database.shard())
    throw Failure(fmt::format("{}: is part {} of a database, expected the whole: see merge-databases",
                              desk.database.path().string(), to_string(part->shard)));
  desk.sensors = sensors_of(desk.database, options);
  desk.sampled = sampled_bridges(desk.database, options.evidence);
}

Answered ask_one(Desk& desk, const ReadingsText& readings) {
  ComparisonSettings settings = comparison_settings(desk.options);
  settings.sampled = desk.sampled;
  Answered asked{&desk,
                 compare(parse_readings(readings.text, readings.name, desk.sensors), desk.sensors,
                         desk.database, settings),
                 desk.settings,
                 {}};
  asked.settings.noise = noise_of(asked.comparison.measured, asked.settings.noise);
  asked.answer = desk.preparations.ask(asked.comparison, asked.settings);
  return asked;
}

AskedDatabase summary_of(const Answered& asked) {
  const Database& database = asked.desk->database;
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
  for (const auto& [desk, comparison, settings, answer, databases] : all)
    readings.push_back(database_readings(desk->database.path().string(), desk->database.control_points(),
                                         comparison, answer));
  require_one_bridge(readings);
  require_same_readings(readings);
}

/// One of several: messages say which.
Answered ask_one_of_several(Desk& desk, const ReadingsText& readings) {
  try {
    return ask_one(desk, readings);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{} (asked of {})", error.what(), desk.database.path().string()));
  }
}

}  // namespace

Desks open_desks(const LocateDamageOptions& options) {
  if (options.databases.size() > 1 && options.settings.objective == Objective::paper)
    throw InputError("several databases are weighed by probabilities, expected --objective posterior");
  Desks desks;
  if (options.databases.empty()) open_desk(options, std::nullopt, desks);
  for (const std::string& file : options.databases) open_desk(options, file, desks);
  return desks;
}

Answered ask(Desks& desks, const ReadingsText& readings) {
  if (desks.size() == 1) return ask_one(desks.front(), readings);
  std::vector<Answered> all;
  for (Desk& desk : desks) all.push_back(ask_one_of_several(desk, readings));
  require_comparable(all);
  std::vector<AskedDatabase> databases;
  for (const Answered& one : all) databases.push_back(summary_of(one));
  weigh(databases);
  const auto likeliest = std::ranges::max_element(
      all, {}, [](const Answered& one) { return one.answer.posterior->log_evidence; });
  likeliest->answer.contested = is_contested(databases);
  likeliest->databases = std::move(databases);
  return std::move(*likeliest);
}

}  // namespace voussoir
