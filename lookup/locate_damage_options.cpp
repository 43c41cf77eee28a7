#include "lookup/locate_damage_options.h"

#include <algorithm>

#include "core/error.h"
#include "core/random.h"
#include "lookup/command_line.h"
#include "lookup/readings/stated_sigmas.h"

namespace voussoir {
namespace {

constexpr std::size_t kMostCandidates = 100000;
constexpr int kMostMissing = 3;
constexpr double kLargestWeight = 1e12;

void add_search_options(CLI::App& app, LocateDamageOptions& options) {
  LookupSettings& settings = options.settings;
  add_choice<Search>(
      app, "--search", settings.search,
      {{"exhaustive", Search::exhaustive}, {"genetic", Search::genetic}, {"nearest", Search::nearest}},
      "exhaustive (default), genetic or nearest (FLANN's linear search)");
  add_choice<Objective>(
      app, "--objective", settings.objective,
      {{"posterior", Objective::posterior}, {"paper", Objective::paper}},
      "posterior (default): probability given the noise; paper: the misfit log(sum |d_measured - d_scene|)");
  app.add_option("--missing", settings.prior.missing,
                 "numbers of missing blocks to consider, such as 0,1; default: those that the database holds")
      ->delimiter(',')
      ->check(CLI::Range(0, kMostMissing))
      ->option_text("LIST");
  app.add_option(
         "--prior", settings.prior.weight,
         "weights of these numbers, what is believed beforehand; default 1000,10,1,0.1: a block has gone in "
         "one of a hundred bridges, two in one of a thousand, three in one of ten thousand (with "
         "--known-bridge 8,1,1,1)")
      ->delimiter(',')
      ->check(number_in_range(0.0, kLargestWeight, "LIST"))
      ->option_text("LIST");
  app.add_option("--top", settings.top, "how many candidates to list, default 10")
      ->check(CLI::Range(std::size_t{1}, kMostCandidates))
      ->option_text("N");
}

void add_reading_options(CLI::App& app, LocateDamageOptions& options) {
  app.add_option(
         "MEASUREMENTS", options.measurements,
         "CSV with a header: point or x_m,y_m (or both), and uy_mm, settlement_mm (positive downwards, all "
         "others upwards) or value_mm, or change_mm, or before_mm and after_mm (_m: in metres); optionally "
         "sigma_mm, load, levelling (a name of what was levelled at once), remark; - reads the standard "
         "input. Several files: "
         "a row each, from all cores")
      ->required()
      ->option_text("FILE...");
  app.add_option("-d,--database", options.databases,
                 "default: $VOUSSOIR_DATABASE, else ./bridge.h5. Several times: the same bridge under other "
                 "assumptions, such as held and sliding ends; the one under which the readings are likeliest "
                 "answers, and says how likely the others are")
      ->allow_extra_args(false)
      ->option_text("FILE");
  app.add_option(
         "--without", options.without,
         "leaves readings out, as if these points or sensors were not in the file: F64,N-west. (An empty "
         "value is a sensor that fell silent, which speaks for the loss of its block.)")
      ->option_text("NAMES");
  app.add_option("--sensors", options.sensors,
                 "CSV of sensors that readings may name beside control points and those of the bridge file, "
                 "with --known-bridge: name, "
                 "quantity (ux, uy, tilt, distance), x_m, y_m, x2_m, y2_m, block, block2")
      ->option_text("FILE");
  add_choice<std::string>(
      app, "--history", options.history, {{kBuiltState, kBuiltState}, {kLostState, kLostState}},
      "whether the blocks were never there (built) or went later (lost); default: built for "
      "displacements since the bridge carried nothing, else lost if the database has it");
  app.add_option(
         "--sigma", options.sigma,
         "standard deviation of every reading that has no sigma_mm, such as 0.02mm; with it the noise "
         "is gaussian and nothing relative unknown")
      ->check(checked_by(parse_sigma, "MM"))
      ->option_text("MM");
}

void add_bridge_options(CLI::App& app, LocateDamageOptions& options) {
  app.add_flag("--known-bridge", options.settings.known_bridge,
               "take the bridge as exactly what the model says; default: its joints, stone, temperature and "
               "supports are uncertain as the bridge file's [uncertainty] states");
  add_choice<ScatterEvidence>(
      app, "--evidence", options.evidence,
      {{"first-order", ScatterEvidence::first_order}, {"variants", ScatterEvidence::variants}},
      "how much readings scatter from bridge to bridge: first-order (default): derivatives of the stored "
      "bridge; variants: also what these leave of bridges drawn at random and solved in full, which the "
      "database holds if it was built with --variants");
  add_choice<Epochs>(
      app, "--epochs", options.settings.epochs, {{"change", Epochs::change}, {"both", Epochs::both}},
      "what before_mm and after_mm are: change (default): only their difference counts, since levellings "
      "have a datum of their own; both: displacements since the bridge carried nothing, so that the first "
      "epoch teaches what the bridge is like");
  add_choice<Conditions>(
      app, "--conditions", options.settings.conditions,
      {{"uncertain", Conditions::uncertain}, {"known", Conditions::known}},
      "temperature, movements of the supports and what all joints soften by alike between two times: "
      "uncertain (default) as the bridge file states, or known: the model's, or the readings have been "
      "corrected for them");
}

void add_noise_options(CLI::App& app, LocateDamageOptions& options) {
  app.add_option(
         "--noise", options.noise_level,
         "errors as a share of the displacement, such as 5% (the bound for uniform noise, else the standard "
         "deviation); default: estimated from the measurements")
      ->check(checked_by(parse_noise_level, "LEVEL"))
      ->option_text("LEVEL");
  app.add_option("--noise-model", options.noise_model,
                 "auto (default: the measurements decide among the next three), uniform, gaussian, laplace, "
                 "student; of a "
                 "bridge that is not exactly known all count as Gaussian of the same variance")
      ->check(checked_by(parse_noise_shape, "NAME"))
      ->option_text("NAME");
  add_millimetres(
      app, "--floor", options.settings.noise.floor,
      "absolute part of the errors of rows without sigma_mm, such as 0.02mm, default 0; beside --noise or "
      "what is estimated as a share");
  app.add_option(
         "--model-error", options.model_error,
         "the model's own error as a share of the change that a missing block makes; default: what the "
         "database states of it (0: none, the paper's setting)")
      ->check(checked_by(parse_noise_level, "LEVEL"))
      ->option_text("LEVEL");
  app.add_option(
         "--silent-sensors", options.silence,
         "chance that a sensor on a standing block gives no reading, default 10%; a listed sensor without "
         "reading speaks for the loss of its block")
      ->check(checked_by(parse_chance, "CHANCE"))
      ->option_text("CHANCE");
  app.add_option("--degrees-of-freedom", options.settings.noise.degrees_of_freedom,
                 "of student noise, default 4")
      ->check(number_in_range(2.1, 1000.0, "NU"))
      ->option_text("NU");
}

void add_nuisance_options(CLI::App& app, LocateDamageOptions& options) {
  app.add_option("--unknown-scale", options.unknown_scale,
                 "how far all displacements may be too large or small by one factor, such as 20%; gaussian "
                 "noise only")
      ->check(checked_by(parse_noise_level, "LEVEL"))
      ->option_text("LEVEL");
  add_millimetres(
      app, "--unknown-datum", options.settings.nuisance.datum,
      "standard deviation of a shift of all heights of one levelling (those of one load, or of one "
      "name in a column levelling), such as 0.3mm; gaussian only");
  add_millimetres(app, "--unknown-tilt", options.settings.nuisance.tilt,
                  "standard deviation of a rotation of the same, such as 0.03mm/m; gaussian only", "mm/m");
}

void add_genetic_options(CLI::App& app, GeneticSettings& genetic) {
  app.add_option("--seed", genetic.seed, "of the genetic search, default 1")
      ->check(CLI::Range(std::uint64_t{0}, kLargestSeed))
      ->option_text("N");
  app.add_option("--generations", genetic.most_generations, "of the genetic search")
      ->check(CLI::Range(1, 1000000))
      ->option_text("N");
  app.add_option("--population", genetic.population, "of the genetic search, default 50")
      ->check(CLI::Range(2, 100000))
      ->option_text("N");
  app.add_option("--crossover", genetic.crossover, "probability, default 0.8")
      ->check(number_in_range(0.0, 1.0, "P"))
      ->option_text("P");
  app.add_option("--mutation", genetic.mutation, "probability, default 0.7")
      ->check(number_in_range(0.0, 1.0, "P"))
      ->option_text("P");
}

}  // namespace

void add_options(CLI::App& app, LocateDamageOptions& options) {
  add_reading_options(app, options);
  add_choice<ReportFormat>(
      app, "--format", options.format,
      {{"text", ReportFormat::text}, {"json", ReportFormat::json}, {"csv", ReportFormat::csv}},
      "text (default), json or csv");
  app.add_option("--report", options.page,
                 "also write a page (HTML) with pictures, tables and what was assumed, complete in itself; "
                 "for a name "
                 "that ends in .svg only the picture of the bridge")
      ->option_text("FILE");
  add_search_options(app, options);
  add_bridge_options(app, options);
  add_noise_options(app, options);
  add_nuisance_options(app, options);
  add_genetic_options(app, options.settings.genetic);
}

LookupSettings finish(const LocateDamageOptions& options) {
  LookupSettings settings = options.settings;
  if (options.measurements.size() > 1 && options.page)
    throw InputError("--report is of one file of readings, expected no others beside it");
  std::vector<int> numbers = settings.prior.missing;
  std::sort(numbers.begin(), numbers.end());
  if (std::adjacent_find(numbers.begin(), numbers.end()) != numbers.end())
    throw InputError("--missing names a number twice, expected each once");
  if (settings.known_bridge && settings.epochs == Epochs::both)
    throw InputError("--epochs both tells what the bridge is like, expected no --known-bridge beside it");
  if (options.evidence == ScatterEvidence::variants &&
      (settings.known_bridge || settings.objective == Objective::paper))
    throw InputError(
        fmt::format("--evidence variants is of a bridge that is not exactly known, expected no {} "
                    "beside it",
                    settings.known_bridge ? "--known-bridge" : "--objective paper"));
  settings.noise.shape = parse_noise_shape(options.noise_model);
  if (!options.noise_level.empty()) settings.noise.relative = parse_noise_level(options.noise_level);
  settings.noise.silence = parse_chance(options.silence);
  settings.nuisance.scale = parse_noise_level(options.unknown_scale);
  return settings;
}

ComparisonSettings comparison_settings(const LocateDamageOptions& options) {
  ComparisonSettings settings;
  settings.known_bridge = options.settings.known_bridge || options.settings.objective == Objective::paper;
  if (!options.history.empty()) settings.history = options.history;
  if (!options.sigma.empty()) settings.sigma = parse_sigma(options.sigma);
  if (!options.model_error.empty()) settings.model_error = parse_noise_level(options.model_error);
  return settings;
}

}  // namespace voussoir
