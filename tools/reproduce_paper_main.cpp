/// @file reproduce-paper: the paper's figures and tables from a database, as one page and CSV files.

#include "core/error.h"
#include "lookup/command_line.h"
#include "tools/reproduction/page.h"

using namespace voussoir;

namespace {

struct Options {
  std::optional<std::string> database;
  std::string cases = paper_cases_file().string();
  std::string folder = "paper";
  ReproductionSettings settings;
};

std::string reproduce(const Options& options) {
  const auto database = Database::open(find_database(options.database));
  const Subject subject(database, read_paper_cases(options.cases), options.settings);
  write_reproduction(subject, reproduce(subject), options.folder);
  return (std::filesystem::path(options.folder) / "index.html").string() + "\n";
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Reproduces the paper's figures and tables from a database: one page, and a CSV file for each.",
      "reproduce-paper");
  app.footer("Example: reproduce-paper -d bridge.h5 -o paper");
  Options options;
  add_database_option(app, options.database);
  app.add_option("-o,--output", options.folder, "folder, default ./paper");
  app.add_option("--cases", options.cases, "file of cases, for another bridge; default: the paper's");
  app.add_option("--trials", options.settings.trials, "seeds of each case, default 50")
      ->check(CLI::Range(1, 100000));
  app.add_option("--random-scenes", options.settings.random_scenes, "of the operating curves, default 150")
      ->check(CLI::Range(1, 100000));
  app.add_option(
      "--wall", options.settings.wall,
      "bridge file of the wall of Fig. 3, examples/bridges/eindhoven-wall.toml; default: left out");
  add_seed_option(app, options.settings.seed, "default 1");
  return run_program(app, argc, argv, [&] { return reproduce(options); });
}
