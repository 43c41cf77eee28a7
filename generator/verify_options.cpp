#include "generator/verify_options.h"

#include <CLI/CLI.hpp>

#include "database/records/provenance.h"

namespace voussoir {
namespace {

constexpr int kMostThreads = 4096;
constexpr int kBadUsage = 2;

}  // namespace

VerifyOptions parse_verify_options(int argc, char** argv) {
  VerifyOptions options;
  CLI::App app("Checks that a database is whole and that what it says is right.", "verify-database");
  app.footer(
      "Example: verify-database bridge.h5 --recompute 20\n\n"
      "Exit codes: 0 no problems, 1 problems (or the file cannot be read), 2 bad usage.");
  app.set_version_flag("--version", version_text("verify-database"));
  std::string format = "text";
  app.add_option("database", options.request.database, "file written by build-database")->required();
  app.add_option("--recompute", options.request.recompute, "solve this many scenes anew and compare")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--seed", options.request.seed, "of the choice of these scenes")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--threads", options.request.threads, "threads, 0: one for each core")
      ->check(CLI::Range(0, kMostThreads))
      ->capture_default_str();
  app.add_option("--format", format, "of the report")
      ->check(CLI::IsMember({"text", "json"}))
      ->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    options.exit_code = app.exit(error) == 0 ? 0 : kBadUsage;
  }
  options.json = format == "json";
  return options;
}

}  // namespace voussoir
