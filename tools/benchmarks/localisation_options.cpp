#include "tools/benchmarks/localisation_options.h"

#include "core/units.h"

namespace voussoir {
namespace {

constexpr int kMost = 1000000;

/// What the lookup is told.
void add_asking_options(CLI::App& app, IrregularOptions& options) {
  add_choice(app, "--conditions", options.settings.conditions,
             {{"known", Conditions::known}, {"uncertain", Conditions::uncertain}},
             "of --irregular: what the lookup is told of temperature, supports and joints of an epoch");
  add_choice(app, "--evidence", options.evidence,
             {{"first-order", ScatterEvidence::first_order}, {"variants", ScatterEvidence::variants}},
             "of --irregular: what the lookup takes for evidence of how bridges scatter");
}

/// The bridges that readings come from.
void add_truth_options(CLI::App& app, IrregularOptions& options) {
  app.add_option(
      "--truth", options.truths,
      "of --irregular: databases of sampled bridges (build-database --variants) that readings come from; "
      "default: they are solved");
  app.add_option("--folder", options.folder, "of --irregular: where solved bridges are kept")
      ->capture_default_str();
  app.add_option("--scatter", options.scatters, "of --irregular: coefficients of variation of the joints")
      ->delimiter(',')
      ->check(number_in_range(0.0, 2.0, "SCATTER"));
  app.add_option("--bridges", options.bridges, "of --irregular: bridges of each kind with missing blocks")
      ->check(CLI::Range(1, kMost))
      ->capture_default_str();
  app.add_option("--intact-bridges", options.intact_bridges, "of --irregular: intact bridges of each kind")
      ->check(CLI::Range(1, kMost))
      ->capture_default_str();
  app.add_flag("--intact-only", options.intact_only, "of --irregular: intact bridges only");
  app.add_option("--kind", options.kind,
                 "of --irregular: only the kinds of bridges whose names contain this, such as 'epochs too'");
}

}  // namespace

void add_irregular_options(CLI::App& app, IrregularOptions& options) {
  add_truth_options(app, options);
  app.add_option_function<std::vector<double>>(
         "--sigma",
         [&](const std::vector<double>& sigmas) {
           options.settings.sigmas.clear();
           for (const double sigma : sigmas) options.settings.sigmas.push_back(kMetresPerMillimetre * sigma);
         },
         "of --irregular: errors of readings [mm], default .01,.03,.1")
      ->delimiter(',')
      ->check(CLI::PositiveNumber);
  add_asking_options(app, options);
  app.add_option("--load", options.settings.load,
                 "of --irregular: readings are of what this load of the bridge file adds, such as crown, "
                 "truck@2; default: of the bridge under its own weight");
  app.add_option("--every", options.settings.every, "of --irregular: take one of so many singles")
      ->check(CLI::Range(1, kMost))
      ->capture_default_str();
  app.add_option("--every-all", options.settings.every_all,
                 "of --irregular: one of so many singles is looked for among all scenes")
      ->check(CLI::Range(1, kMost))
      ->capture_default_str();
  app.add_option("--json", options.json, "of --irregular: also write the results to this file");
  app.add_option("--page", options.page, "of --irregular: also write an HTML page to this file");
}

}  // namespace voussoir
