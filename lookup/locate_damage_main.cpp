/// @file locate-damage: which blocks are missing, from measured displacements.

#include "core/error.h"
#include "core/text_file.h"
#include "core/threads.h"
#include "lookup/command_line.h"
#include "lookup/locate_damage_options.h"
#include "lookup/lookup.h"
#include "lookup/preparations.h"
#include "lookup/readings/comparison.h"
#include "lookup/readings/sensors_file.h"
#include "lookup/readings/stated_sigmas.h"
#include "lookup/report/report.h"
#include "lookup/report/survey_report.h"

namespace {

voussoir::SensorList sensors_of(const voussoir::Database& database,
                                const voussoir::LocateDamageOptions& options) {
  voussoir::SensorList list = voussoir::control_point_sensors(database.control_points());
  if (options.sensors) voussoir::read_sensors(*options.sensors, database.layout(), database.mesh(), list);
  return list;
}

/// What a question needs beside its readings.
struct Desk {
  const voussoir::LocateDamageOptions& options;
  voussoir::LookupSettings settings;
  voussoir::Database database;
  voussoir::SensorList sensors;
  std::shared_ptr<const voussoir::SampledBridges> sampled{};  // null: the first order speaks
  voussoir::Preparations preparations{};
};

/// A question with its answer.
struct Answered {
  voussoir::Comparison comparison;
  voussoir::LookupSettings settings;
  voussoir::Answer answer;
};

Answered ask(Desk& desk, const std::string& file) {
  voussoir::ComparisonSettings settings = comparison_settings(desk.options);
  settings.sampled = desk.sampled;
  Answered asked{
      voussoir::compare(voussoir::read_readings(file, desk.sensors), desk.sensors, desk.database, settings),
      desk.settings,
      {}};
  asked.settings.noise = voussoir::noise_of(asked.comparison.measured, asked.settings.noise);
  asked.answer = desk.preparations.ask(asked.comparison, asked.settings);
  return asked;
}

std::string report_one(Desk& desk) {
  const std::string& file = desk.options.measurements.front();
  const auto [comparison, settings, answer] = ask(desk, file);
  const voussoir::Source source{file, desk.database.path().string(), desk.database.bridge_name(),
                                desk.database.digest(), desk.database.stands_by_slip()};
  if (const auto& page = desk.options.page)
    voussoir::write_file(*page, page->extension() == ".svg"
                                    ? voussoir::picture_report(answer, comparison)
                                    : voussoir::page_report(answer, settings, comparison, source));
  return voussoir::report(answer, settings, comparison, source, desk.options.format);
}

/// A file that cannot be answered has a row, too, and does not stop the others.
voussoir::SurveyRow row_of(Desk& desk, const std::string& file) {
  try {
    const auto [comparison, settings, answer] = ask(desk, file);
    return voussoir::survey_row(file, answer, settings, comparison);
  } catch (const std::exception& error) {
    return {file, error.what()};
  }
}

voussoir::ProgramOutput report_all(Desk& desk) {
  const std::vector<std::string>& files = desk.options.measurements;
  std::vector<voussoir::SurveyRow> rows(files.size());
  voussoir::for_each_index_on_threads(files.size(), voussoir::hardware_threads(),
                                      [&](std::size_t i) { rows[i] = row_of(desk, files[i]); });
  const auto failed = std::ranges::count_if(rows, [](const auto& row) { return !row.error.empty(); });
  return {voussoir::survey_report(rows, desk.options.format),
          failed == 0 ? std::string() : fmt::format("{} of {} files have no answer", failed, rows.size())};
}

voussoir::ProgramOutput locate(const voussoir::LocateDamageOptions& options) {
  if (options.measurements.size() == 1) voussoir::share_heap();
  Desk desk{
      options, finish(options), voussoir::Database::open(voussoir::find_database(options.database)), {}};
  if (const auto& part = desk.database.shard())
    throw voussoir::Failure(
        fmt::format("{}: is part {} of a database, expected the whole: see merge-databases",
                    desk.database.path().string(), to_string(part->shard)));
  desk.sensors = sensors_of(desk.database, options);
  desk.sampled = sampled_bridges(desk.database, options.evidence);
  if (options.measurements.size() == 1) return report_one(desk);
  return report_all(desk);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Finds the missing blocks of a masonry arch bridge from measured displacements.",
               "locate-damage");
  app.footer(
      "Example: locate-damage readings.csv -d bridge.h5 --noise 5%\n"
      "         locate-damage survey/*.csv -d bridge.h5 --format csv > survey.csv\n"
      "         build-database my-bridge.toml -o sampled.h5 --variants 50 --history built,lost\n"
      "         locate-damage readings.csv -d sampled.h5 --sigma 0.02mm --evidence variants");
  app.set_version_flag("--version", voussoir::version_text("locate-damage"));
  voussoir::LocateDamageOptions options;
  voussoir::add_options(app, options);
  return voussoir::run_program(app, argc, argv, [&] { return locate(options); });
}
