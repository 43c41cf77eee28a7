/// @file locate-damage: which blocks are missing, from measured displacements.

#include "core/error.h"
#include "lookup/command_line.h"
#include "lookup/locate_damage_options.h"
#include "lookup/lookup.h"
#include "lookup/report/report.h"
#include "lookup/report/text_file.h"

namespace {

std::string locate(const voussoir::LocateDamageOptions& options) {
  const voussoir::LookupSettings settings = finish(options);
  const auto database = voussoir::Database::open(voussoir::find_database(options.database));
  const voussoir::Comparison comparison = voussoir::absolute_readings(
      voussoir::library_of(database),
      voussoir::read_measurements(options.measurements, database.control_points()));
  const voussoir::Answer answer = voussoir::locate_damage(comparison, settings);
  const voussoir::Source source{options.measurements, database.path().string(), database.bridge_name(),
                                database.digest()};
  if (options.page)
    voussoir::write_file(*options.page, options.page->extension() == ".svg"
                                            ? voussoir::picture_report(answer, comparison)
                                            : voussoir::page_report(answer, settings, comparison, source));
  return voussoir::report(answer, settings, comparison.library, source, options.format);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Finds the missing blocks of a masonry arch bridge from measured vertical displacements.",
               "locate-damage");
  app.footer("Example: locate-damage readings.csv -d bridge.h5 --noise 5%");
  app.set_version_flag("--version", voussoir::version_text("locate-damage"));
  voussoir::LocateDamageOptions options;
  voussoir::add_options(app, options);
  return voussoir::run_program(app, argc, argv, [&] { return locate(options); });
}
