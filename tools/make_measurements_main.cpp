/// @file make-measurements: a measurements file with the errors of one's choice, from a scene of a database.

#include <algorithm>

#include "core/error.h"
#include "core/random.h"
#include "core/text_file.h"
#include "core/units.h"
#include "lookup/command_line.h"
#include "lookup/readings/readings_csv.h"
#include "lookup/readings/sensors_file.h"
#include "lookup/readings/simulate.h"
#include "lookup/readings/stated_sigmas.h"
#include "lookup/report/field_query.h"

using namespace voussoir;

namespace {

constexpr const char* kUsualNoise = "5%";

enum class Kind { absolute, change, epochs };

struct Options {
  std::string scene;
  std::optional<std::string> database;
  Kind kind = Kind::absolute;
  std::optional<std::string> history;
  std::vector<std::string> loads;
  std::optional<std::string> sensors;
  std::optional<std::string> noise_level;  // default kUsualNoise
  NoiseShape noise_model = NoiseShape::uniform;
  double floor = 0.0;           // [m]
  std::optional<double> sigma;  // [m]
  Nuisance levelling;
  double silence = 0.0;
  std::uint64_t seed = 1;
  bool hide = false;
  std::string output;
};

/// Readings of two times are nothing to locate-damage unless their errors are stated: a share of what has not
/// changed is none.
void require_errors(const Options& options) {
  const bool stated = options.sigma || options.noise_level || options.floor > 0.0;
  if (options.kind == Kind::absolute || stated) return;
  throw InputError(fmt::format("--kind {} without an error of what has not changed, expected --sigma 0.02mm",
                               options.kind == Kind::change ? "change" : "epochs"));
}

NoiseModel noise_of(const Options& options) {
  NoiseModel noise;
  noise.silence = options.silence;
  if (options.sigma) {
    noise.shape = NoiseShape::gaussian;
    noise.relative = 0.0;
    noise.floor = *options.sigma;
    return noise;
  }
  noise.shape = options.noise_model;
  noise.relative = parse_noise_level(options.noise_level.value_or(kUsualNoise));
  noise.floor = options.floor;
  return noise;
}

ReadingKind reading_kind(const Options& options) {
  if (options.loads.empty())
    return options.kind == Kind::absolute ? ReadingKind::absolute : ReadingKind::change;
  if (options.kind == Kind::change)
    throw InputError("--load with --kind change, expected --kind absolute (what the load adds) or epochs");
  return options.kind == Kind::absolute ? ReadingKind::load : ReadingKind::load_change;
}

/// Each once, as a file of readings has each point once under a load.
void require_loads(const std::vector<std::string>& loads) {
  for (std::size_t i = 0; i < loads.size(); ++i) {
    if (loads[i].empty()) throw InputError("--load: names no load, expected such as crown or truck@2");
    if (std::find(loads.begin(), loads.begin() + static_cast<std::ptrdiff_t>(i), loads[i]) !=
        loads.begin() + static_cast<std::ptrdiff_t>(i))
      throw InputError(fmt::format("--load: {} comes twice", loads[i]));
  }
}

std::string_view what_is_read(ReadingKind kind) {
  switch (kind) {
    case ReadingKind::change:
      return "changes between two times";
    case ReadingKind::load:
      return "what loads add";
    case ReadingKind::load_change:
      return "what loads add, at two times";
    default:
      return "displacements since the bridge carried nothing";
  }
}

std::string errors_in_words(const Options& options) {
  std::string text =
      !options.sigma
          ? fmt::format("{} of the value and {:g} mm, {}", options.noise_level.value_or(kUsualNoise),
                        kMillimetres * options.floor, to_string(options.noise_model))
          : fmt::format("gaussian, standard deviation {} mm", kMillimetres * *options.sigma);
  const Nuisance& levelling = options.levelling;
  if (levelling.datum > 0.0) text += fmt::format(", datum {:g} mm", kMillimetres * levelling.datum);
  if (levelling.tilt > 0.0) text += fmt::format(", tilt {:g} mm per m", kMillimetres * levelling.tilt);
  return text;
}

std::string heading(const Options& options, const Comparison& comparison, const Database& database,
                    Outcome outcome) {
  std::string text = fmt::format("# Simulated readings of the bridge '{}': {} (history {}).\n",
                                 database.bridge_name(), what_is_read(comparison.kind), comparison.history);
  if (!options.hide) text += fmt::format("# scene: {}\n", options.scene);
  if (outcome != Outcome::standing)
    text += "# The scene falls: displacements are those shortly after gravity acts, no equilibrium.\n";
  return text + fmt::format("# errors: {}\n# seed: {}\n", errors_in_words(options), options.seed);
}

std::string make_measurements(const Options& options) {
  std::vector<std::filesystem::path> read;
  if (options.sensors) read.emplace_back(*options.sensors);
  if (!options.output.empty()) check_output("--output", options.output, {}, read);
  require_errors(options);
  const NoiseModel noise = noise_of(options);
  const auto database = Database::open(find_database(options.database));
  const SensorList list = all_sensors(database, options.sensors);
  ReadingsFile blank = blank_file(list, reading_kind(options), options.loads);
  blank.name = "--load";
  blank.two_epochs = options.kind == Kind::epochs;
  ComparisonSettings settings;
  settings.known_bridge = true;  // what is uncertain is no part of what is measured
  settings.history = options.history;
  const Comparison comparison = compare(blank, list, database, settings);
  require_loads(options.loads);
  Random random(options.seed);
  const std::size_t row = find_row(database, options.scene);
  const auto outcome = static_cast<Outcome>(comparison.library.table.outcome[row]);
  if (outcome == Outcome::unresolved)
    throw Failure(fmt::format("scene {} has no answer in {}, so nobody knows what would be read",
                              options.scene, database.path().string()));
  const ReadingsFile file = simulate_file(blank, comparison, row, noise, options.levelling, random);
  const std::string text = heading(options, comparison, database, outcome) + to_csv(file, list, &noise);
  if (options.output.empty()) return text;
  write_file(options.output, text);
  return {};
}

void add_reading_options(CLI::App& app, Options& options) {
  add_choice<Kind>(
      app, "--kind", options.kind,
      {{"absolute", Kind::absolute}, {"change", Kind::change}, {"epochs", Kind::epochs}},
      "absolute (default): displacements since the bridge carried nothing, with --load what the load "
      "adds; change: between two times; epochs: the same as values before, which have no error, and after, "
      "which have all of it");
  add_history_option(app, options.history,
                     "whether the blocks were never there or went later; default: as locate-damage");
  app.add_option("--load", options.loads, "load cases to read under, such as axle,truck@2")
      ->delimiter(',')
      ->option_text("LIST");
  app.add_option("--sensors", options.sensors,
                 "sensors to read beside the control points, as for locate-damage")
      ->option_text("FILE");
}

void add_error_options(CLI::App& app, Options& options) {
  CLI::Option* const level = app.add_option("--noise", options.noise_level, "share of the value, default 5%")
                                 ->check(checked_by(parse_noise_level, "LEVEL"))
                                 ->option_text("LEVEL");
  CLI::Option* const model = add_choice<NoiseShape>(app, "--noise-model", options.noise_model,
                                                    {{"uniform", NoiseShape::uniform},
                                                     {"gaussian", NoiseShape::gaussian},
                                                     {"laplace", NoiseShape::laplace},
                                                     {"student", NoiseShape::student}},
                                                    "default uniform");
  CLI::Option* const floor =
      add_millimetres(app, "--floor", options.floor, "absolute part, such as 0.02mm, default 0");
  add_parsed(app, "--sigma", options.sigma, parse_sigma, "MM",
             "instead of these: standard deviation of every value, such as 0.02mm; written as sigma_mm")
      ->excludes(level)
      ->excludes(model)
      ->excludes(floor);
  add_millimetres(app, "--datum", options.levelling.datum,
                  "standard deviation of a shift of all heights of one levelling, such as 0.3mm, default 0");
  add_millimetres(
      app, "--tilt", options.levelling.tilt,
      "standard deviation of a rotation of all heights of one levelling, such as 0.03mm/m, default 0",
      "mm/m");
  add_parsed(app, "--silent-sensors", options.silence, parse_chance, "CHANCE",
             "chance that a sensor gives no reading, default 0%");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Writes a measurements file: what sensors would read in a scene, with simulated errors of "
      "the instruments. Joints, temperature and supports are the model's in all epochs, so such "
      "files are easier than a real bridge's.",
      "make-measurements");
  app.footer("Example: make-measurements 10,4 -d bridge.h5 --kind change --sigma 0.02mm -o readings.csv");
  app.set_version_flag("--version", version_text("make-measurements"));
  Options options;
  app.add_option("SCENE", options.scene, "missing blocks: intact, 10,4 or 10,4+6,4")
      ->required()
      ->option_text("SCENE");
  add_database_option(app, options.database);
  add_reading_options(app, options);
  add_error_options(app, options);
  add_seed_option(app, options.seed, "of the random numbers, default 1");
  app.add_flag("--hide", options.hide, "do not name the scene in the file");
  app.add_option("-o,--output", options.output, "default: the standard output")->option_text("FILE");
  return run_program(app, argc, argv, [&] { return make_measurements(options); });
}
