/// @file query-field: the displacement field of a scene.

#include "core/error.h"
#include "database/records/state_name.h"
#include "lookup/command_line.h"
#include "lookup/report/field_query.h"
#include "lookup/report/field_report.h"

using voussoir::FieldFormat;

namespace {

struct Options {
  std::string scene;
  std::optional<std::string> database;
  std::optional<std::string> at;
  std::optional<std::string> history;
  std::optional<std::string> load;
  FieldFormat format = FieldFormat::csv;
};

std::string query(const Options& options) {
  if (options.at && (options.format == FieldFormat::vtu || options.format == FieldFormat::svg))
    throw voussoir::InputError("--format vtu and svg are of the whole field, expected no --at beside them");
  const auto database = voussoir::Database::open(voussoir::find_database(options.database));
  const std::size_t row = voussoir::find_row(database, options.scene);
  const std::size_t state = voussoir::find_state(database, options.history, options.load);
  const auto outcome =
      static_cast<voussoir::Outcome>(database.table(voussoir::kNominalVariant, state).outcome[row]);
  if (outcome != voussoir::Outcome::standing)
    fmt::print(stderr, "query-field: note: scene {} is {} as {}, its field is no equilibrium\n",
               options.scene, voussoir::to_string(outcome), database.states()[state]);
  if (!options.at) return voussoir::field_report(database, row, state, options.format);
  const auto places = voussoir::displacements_at(database, row, state, *options.at);
  return options.format == FieldFormat::json ? voussoir::places_json(places) : voussoir::places_csv(places);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Prints the displacements of a scene: all nodes, or chosen places.", "query-field");
  app.footer("Example: query-field 10,4+6,4 -d bridge.h5 --at T12,A3 --format json");
  app.set_version_flag("--version", voussoir::version_text("query-field"));
  Options options;
  app.add_option("SCENE", options.scene, "missing blocks: intact, 10,4 or 10,4+6,4")
      ->required()
      ->option_text("SCENE");
  app.add_option("-d,--database", options.database, "default: $VOUSSOIR_DATABASE, else ./bridge.h5")
      ->option_text("FILE");
  app.add_option("--at", options.at,
                 "control points such as T12,A3, coordinates X,Y in metres, or control for all")
      ->option_text("PLACES");
  app.add_option(
         "--history", options.history,
         "built: the blocks were missing from the start, or lost: they went when the bridge carried its "
         "weight; default: the database's first")
      ->check(CLI::IsMember({voussoir::kBuiltState, voussoir::kLostState}))
      ->option_text("NAME");
  app.add_option("--load", options.load,
                 "with this load case, or at this step of it (truck@2); default: none")
      ->option_text("NAME");
  voussoir::add_choice<FieldFormat>(
      app, "--format", options.format,
      {{"csv", FieldFormat::csv},
       {"json", FieldFormat::json},
       {"vtu", FieldFormat::vtu},
       {"svg", FieldFormat::svg}},
      "csv (default), json, vtu for ParaView, or svg: a picture of the deformed bridge");
  return voussoir::run_program(app, argc, argv, [&] { return query(options); });
}
