#include "generator/verify_options.h"

#include "core/program/command_line.h"
#include "database/records/provenance.h"

namespace voussoir {
namespace {

constexpr int kMostRecomputed = 1000000000;

}  // namespace

void add_options(CLI::App& app, VerifyOptions& options) {
  app.footer(
      "Example: verify-database bridge.h5 --recompute 20\n\n"
      "Exit codes: 0 no problems, 1 problems (or the file cannot be read), 2 bad usage.");
  app.set_version_flag("--version", version_text("verify-database"));
  app.add_option("database", options.request.database, "file written by build-database")
      ->required()
      ->option_text("FILE");
  app.add_option("--recompute", options.request.recompute,
                 "solve this many scenes anew and compare, default 0")
      ->check(CLI::Range(0, kMostRecomputed))
      ->option_text("N");
  add_seed_option(app, options.request.seed, "of the choice of these scenes, default 1");
  add_threads_option(app, options.request.threads);
  add_format_option(app, options.json, "of the report");
}

}  // namespace voussoir
