/// @file locate-damage: which blocks are missing, from measured displacements.

#include "core/error.h"
#include "core/text_file.h"
#include "lookup/command_line.h"
#include "lookup/locate_damage_options.h"
#include "lookup/lookup.h"
#include "lookup/readings/comparison.h"
#include "lookup/readings/sensors_file.h"
#include "lookup/readings/stated_sigmas.h"
#include "lookup/report/report.h"

namespace {

voussoir::SensorList sensors_of(const voussoir::Database& database,
                                const voussoir::LocateDamageOptions& options) {
  voussoir::SensorList list = voussoir::control_point_sensors(database.control_points());
  if (options.sensors) voussoir::read_sensors(*options.sensors, database.layout(), database.mesh(), list);
  return list;
}

std::string locate(const voussoir::LocateDamageOptions& options) {
  voussoir::LookupSettings settings = finish(options);
  const auto database = voussoir::Database::open(voussoir::find_database(options.database));
  const voussoir::SensorList sensors = sensors_of(database, options);
  const voussoir::Comparison comparison =
      voussoir::compare(voussoir::read_readings(options.measurements, sensors), sensors, database,
                        comparison_settings(options));
  settings.noise = voussoir::noise_of(comparison.measured, settings.noise);
  const voussoir::Answer answer = voussoir::locate_damage(comparison, settings);
  const voussoir::Source source{options.measurements, database.path().string(), database.bridge_name(),
                                database.digest()};
  if (options.page)
    voussoir::write_file(*options.page, options.page->extension() == ".svg"
                                            ? voussoir::picture_report(answer, comparison)
                                            : voussoir::page_report(answer, settings, comparison, source));
  return voussoir::report(answer, settings, comparison, source, options.format);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Finds the missing blocks of a masonry arch bridge from measured displacements.",
               "locate-damage");
  app.footer("Example: locate-damage readings.csv -d bridge.h5 --noise 5%");
  app.set_version_flag("--version", voussoir::version_text("locate-damage"));
  voussoir::LocateDamageOptions options;
  voussoir::add_options(app, options);
  return voussoir::run_program(app, argc, argv, [&] { return locate(options); });
}
