#include "lookup/locate_damage_options.h"

#include <algorithm>

#include "core/error.h"
#include "lookup/command_line.h"
#include "lookup/readings/stated_sigmas.h"

namespace voussoir {
namespace {

constexpr std::size_t kMostCandidates = 100000;
constexpr int kMostMissing = 3;
constexpr double kLargestWeight = 1e12;

void add_search_options(CLI::App& app, LocateDamageOptions& options) {
  LookupSettings& settings = options.question.lookup;
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
         "--without", options.question.without,
         "leaves readings out, as if these points or sensors were not in the file: F64,N-west. (An empty "
         "value is a sensor that fell silent, which speaks for the loss of its block.)")
      ->option_text("NAMES");
  app.add_option("--sensors", options.question.sensors,
                 "CSV of sensors that readings may name beside control points and those of the bridge file, "
                 "with --known-bridge: name, "
                 "quantity (ux, uy, tilt, distance), x_m, y_m, x2_m, y2_m, block, block2")
      ->option_text("FILE");
  add_history_option(app, options.question.comparison.history,
                     "whether the blocks were never there (built) or went later (lost); default: built for "
                     "displacements since the bridge carried nothing, else lost if the database has it");
  add_parsed(app, "--sigma", options.question.comparison.sigma, parse_sigma, "MM",
             "standard deviation of every reading that has no sigma_mm, such as 0.02mm; with it the noise "
             "is gaussian and nothing relative unknown");
}

void add_bridge_options(CLI::App& app, QuestionSettings& question) {
  app.add_flag("--known-bridge", question.lookup.known_bridge,
               "take the bridge as exactly what the model says; default: its joints, stone, temperature and "
               "supports are uncertain as the bridge file's [uncertainty] states");
  add_choice<ScatterEvidence>(
      app, "--evidence", question.evidence,
      {{"first-order", ScatterEvidence::first_order}, {"variants", ScatterEvidence::variants}},
      "how much readings scatter from bridge to bridge: first-order (default): derivatives of the stored "
      "bridge; variants: also what these leave of bridges drawn at random and solved in full, which the "
      "database holds if it was built with --variants");
  add_choice<Epochs>(
      app, "--epochs", question.lookup.epochs, {{"change", Epochs::change}, {"both", Epochs::both}},
      "what before_mm and after_mm are: change (default): only their difference counts, since levellings "
      "have a datum of their own; both: displacements since the bridge carried nothing, so that the first "
      "epoch teaches what the bridge is like");
  add_choice<Conditions>(
      app, "--conditions", question.lookup.conditions,
      {{"uncertain", Conditions::uncertain}, {"known", Conditions::known}},
      "temperature, movements of the supports and what all joints soften by alike between two times: "
      "uncertain (default) as the bridge file states, or known: the model's, or the readings have been "
      "corrected for them");
}

void add_noise_options(CLI::App& app, QuestionSettings& question) {
  NoiseModel& noise = question.lookup.noise;
  add_parsed(app, "--noise", noise.relative, parse_noise_level, "LEVEL",
             "errors as a share of the displacement, such as 5% (the bound for uniform noise, else the "
             "standard deviation); default: estimated from the measurements");
  add_parsed(app, "--noise-model", noise.shape, parse_noise_shape, "NAME",
             "auto (default: the measurements decide among the next three), uniform, gaussian, laplace, "
             "student; of a bridge that is not exactly known all count as Gaussian of the same variance");
  add_millimetres(
      app, "--floor", noise.floor,
      "absolute part of the errors of rows without sigma_mm, such as 0.02mm, default 0; beside --noise or "
      "what is estimated as a share");
  add_parsed(app, "--model-error", question.comparison.model_error, parse_noise_level, "LEVEL",
             "the model's own error as a share of the change that a missing block makes; default: what the "
             "database states of it (0: none, the paper's setting)");
  add_parsed(app, "--silent-sensors", noise.silence, parse_chance, "CHANCE",
             "chance that a sensor on a standing block gives no reading, default 10%; a listed sensor "
             "without reading speaks for the loss of its block");
  app.add_option("--degrees-of-freedom", noise.degrees_of_freedom, "of student noise, default 4")
      ->check(number_in_range(2.1, 1000.0, "NU"))
      ->option_text("NU");
}

void add_nuisance_options(CLI::App& app, Nuisance& nuisance) {
  add_parsed(app, "--unknown-scale", nuisance.scale, parse_noise_level, "LEVEL",
             "how far all displacements may be too large or small by one factor, such as 20%; gaussian "
             "noise only");
  add_millimetres(
      app, "--unknown-datum", nuisance.datum,
      "standard deviation of a shift of all heights of one levelling (those of one load, or of one "
      "name in a column levelling), such as 0.3mm; gaussian only");
  add_millimetres(app, "--unknown-tilt", nuisance.tilt,
                  "standard deviation of a rotation of the same, such as 0.03mm/m; gaussian only", "mm/m");
}

void add_genetic_options(CLI::App& app, GeneticSettings& genetic) {
  add_seed_option(app, genetic.seed, "of the genetic search, default 1");
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
  add_bridge_options(app, options.question);
  add_noise_options(app, options.question);
  add_nuisance_options(app, options.question.lookup.nuisance);
  add_genetic_options(app, options.question.lookup.genetic);
}

QuestionSettings question_of(const LocateDamageOptions& options) {
  QuestionSettings question = options.question;
  const LookupSettings& lookup = question.lookup;
  if (options.measurements.size() > 1 && options.page)
    throw InputError("--report takes one file of readings, expected no others beside it");
  std::vector<int> numbers = lookup.prior.missing;
  std::sort(numbers.begin(), numbers.end());
  if (std::adjacent_find(numbers.begin(), numbers.end()) != numbers.end())
    throw InputError("--missing names a number twice, expected each once");
  if (lookup.known_bridge && lookup.epochs == Epochs::both)
    throw InputError("--epochs both tells what the bridge is like, expected no --known-bridge beside it");
  const bool ranks_by_misfit = lookup.objective == Objective::paper;
  if (question.evidence == ScatterEvidence::variants && (lookup.known_bridge || ranks_by_misfit))
    throw InputError(
        fmt::format("--evidence variants is of a bridge that is not exactly known, expected no {} "
                    "beside it",
                    lookup.known_bridge ? "--known-bridge" : "--objective paper"));
  question.comparison.known_bridge = lookup.known_bridge || ranks_by_misfit;
  question.databases = find_databases(options.databases);
  return question;
}

}  // namespace voussoir
