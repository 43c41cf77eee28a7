/// @file make-measurements: a measurements file with the noise of one's choice, from a scene of a database.

#include "core/error.h"
#include "lookup/command_line.h"
#include "lookup/readings/simulate.h"
#include "lookup/report/field_query.h"
#include "lookup/report/text_file.h"

namespace {

struct Options {
  std::string scene;
  std::optional<std::string> database;
  std::string noise_level = "5%";
  std::string noise_model = "uniform";
  double floor_mm = 0.0;
  std::string silence = "0%";
  std::uint64_t seed = 1;
  bool hide = false;
  std::string output;
};

std::string heading(const Options& options, const voussoir::Database& database) {
  std::string text =
      fmt::format("# Simulated levelling of the bridge '{}': vertical displacements under its own weight.\n",
                  database.bridge_name());
  if (!options.hide) text += fmt::format("# scene: {}\n", options.scene);
  text += fmt::format("# noise: {} of the displacement and {} mm, {}\n# seed: {}\n", options.noise_level,
                      options.floor_mm, options.noise_model, options.seed);
  return text;
}

std::string make_measurements(const Options& options) {
  const auto database = voussoir::Database::open(voussoir::find_database(options.database));
  const auto row = database.table().row(voussoir::find_row(database, options.scene));
  const voussoir::NoiseModel noise{voussoir::parse_noise_shape(options.noise_model),
                                   voussoir::parse_noise_level(options.noise_level), 1e-3 * options.floor_mm,
                                   4.0, voussoir::parse_noise_level(options.silence)};
  if (noise.shape == voussoir::NoiseShape::automatic)
    throw voussoir::InputError(
        "--noise-model auto cannot be simulated, expected uniform, gaussian, laplace or student");
  voussoir::Random random(options.seed);
  const auto readings = voussoir::simulate_readings(row, noise, random);
  const std::string text = heading(options, database) + voussoir::to_csv(readings, database.control_points());
  if (options.output.empty()) return text;
  voussoir::write_file(options.output, text);
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Writes a measurements file: a scene's displacements with simulated noise.",
               "make-measurements");
  app.footer("Example: make-measurements 10,4 -d bridge.h5 --noise 5% --seed 1 -o readings.csv");
  app.set_version_flag("--version", voussoir::version_text("make-measurements"));
  Options options;
  app.add_option("SCENE", options.scene, "missing blocks: intact, 10,4 or 10,4+6,4")
      ->required()
      ->option_text("SCENE");
  app.add_option("-d,--database", options.database, "default: $VOUSSOIR_DATABASE, else ./bridge.h5");
  app.add_option("--noise", options.noise_level, "share of the displacement, default 5%")
      ->check(voussoir::checked_by(voussoir::parse_noise_level, "LEVEL"));
  app.add_option("--noise-model", options.noise_model, "uniform (default), gaussian, laplace or student")
      ->check(voussoir::checked_by(voussoir::parse_noise_shape, "NAME"));
  app.add_option("--floor", options.floor_mm, "absolute part [mm], default 0")
      ->check(voussoir::number_in_range(0.0, 1e6, "MM"));
  app.add_option("--silent-sensors", options.silence, "chance that a sensor gives no reading, default 0%")
      ->check(voussoir::checked_by(voussoir::parse_noise_level, "LEVEL"));
  app.add_option("--seed", options.seed, "of the random numbers, default 1");
  app.add_flag("--hide", options.hide, "do not name the scene in the file");
  app.add_option("-o,--output", options.output, "default: the standard output");
  return voussoir::run_program(app, argc, argv, [&] { return make_measurements(options); });
}
