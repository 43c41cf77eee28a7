/// @file query-field: the displacements of a scene and the forces in it.

#include "core/error.h"
#include "lookup/command_line.h"
#include "lookup/report/field_query.h"
#include "lookup/report/field_report.h"
#include "lookup/report/forces_report.h"

using namespace voussoir;

namespace {

struct Options {
  std::string scene;
  std::optional<std::string> database;
  std::optional<std::string> at;
  std::optional<std::string> history;
  std::optional<std::string> load;
  FieldQuantity show = FieldQuantity::displacements;
  FieldFormat format = FieldFormat::csv;
};

std::string query(const Options& options) {
  if (options.at && (options.format == FieldFormat::vtu || options.format == FieldFormat::svg))
    throw InputError("--format vtu and svg are of the whole field, expected no --at beside them");
  if (options.at && options.show != FieldQuantity::displacements)
    throw InputError("--at gives displacements, expected no --show of something else beside it");
  const auto database = Database::open(find_database(options.database));
  const std::size_t row = find_row(database, options.scene);
  const std::size_t state = find_state(database, options.history, options.load);
  if (options.show != FieldQuantity::displacements)
    return forces_report(database, row, state, options.show, options.format);
  const auto outcome = static_cast<Outcome>(database.table(kNominalVariant, state).outcome[row]);
  expect_displacements(database, row, state);
  if (outcome != Outcome::standing)
    fmt::print(stderr, "query-field: note: scene {} is {} as {}, its field is no equilibrium\n",
               options.scene, to_string(outcome), database.states()[state]);
  if (!options.at) return field_report(database, row, state, options.format);
  return places_report(displacements_at(database, row, state, *options.at), options.format);
}

void add_options(CLI::App& app, Options& options) {
  app.add_option("SCENE", options.scene, "missing blocks: intact, 10,4 or 10,4+6,4")
      ->required()
      ->option_text("SCENE");
  add_database_option(app, options.database);
  app.add_option(
         "--at", options.at,
         "control points, or sensors of the bridge file that move, such as T12,A3, coordinates X,Y "
         "in metres (where blocks meet of each of them), or control for all: with x_m and y_m, as a list "
         "for setting out")
      ->option_text("PLACES");
  add_history_option(
      app, options.history,
      "built: the blocks were missing from the start, or lost: they went when the bridge carried its weight; "
      "default: the database's first");
  app.add_option("--load", options.load,
                 "with this load case, or at this step of it (truck@2); default: none")
      ->option_text("NAME");
  add_choice<FieldQuantity>(
      app, "--show", options.show,
      {{"displacements", FieldQuantity::displacements},
       {"stresses", FieldQuantity::stresses},
       {"joints", FieldQuantity::joints},
       {"thrust", FieldQuantity::thrust}},
      "displacements (default); stresses: of every triangle; joints: pressure, shear, opening and state "
      "(open, sticking, "
      "sliding) of every joint; thrust: where the resultant crosses each joint of a ring");
  add_choice<FieldFormat>(app, "--format", options.format,
                          {{"csv", FieldFormat::csv},
                           {"json", FieldFormat::json},
                           {"vtu", FieldFormat::vtu},
                           {"svg", FieldFormat::svg}},
                          "csv (default), json, vtu for ParaView, or svg: a picture");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Prints displacements, stresses, joints or thrust lines of a scene.", "query-field");
  app.footer(
      "Example: query-field 10,4+6,4 -d bridge.h5 --at T12,A3 --format json\n"
      "         query-field 10,4 --history lost --show joints --format svg > joints.svg\n"
      "         query-field intact --load truck@2 --show thrust --format svg > thrust.svg");
  app.set_version_flag("--version", version_text("query-field"));
  Options options;
  add_options(app, options);
  return run_program(app, argc, argv, [&] { return query(options); });
}
