#include "generator/verify_options.h"

#include "core/random.h"
#include "database/records/provenance.h"
#include "generator/command_line.h"

namespace voussoir {
namespace {

constexpr int kMostRecomputed = 1000000000;

}  // namespace

VerifyOptions parse_verify_options(int argc, char** argv) {
  VerifyOptions options;
  CLI::App app("Checks that a database is whole and that what it says is right.", "verify-database");
  app.footer(
      "Example: verify-database bridge.h5 --recompute 20\n\n"
      "Exit codes: 0 no problems, 1 problems (or the file cannot be read), 2 bad usage.");
  app.set_version_flag("--version", version_text("verify-database"));
  app.add_option("database", options.request.database, "file written by build-database")->required();
  app.add_option("--recompute", options.request.recompute, "solve this many scenes anew and compare")
      ->check(CLI::Range(0, kMostRecomputed))
      ->capture_default_str();
  app.add_option("--seed", options.request.seed, "of the choice of these scenes")
      ->check(CLI::Range(std::uint64_t{0}, kLargestSeed))
      ->capture_default_str();
  add_threads_option(app, options.request.threads);
  add_format_option(app, options.json, "of the report");
  options.exit_code = parse_command_line(app, argc, argv);
  return options;
}

}  // namespace voussoir
