/// @file benchmark-lookup: how fast lookups are, in process, on one core.

#include "core/error.h"
#include "lookup/command_line.h"
#include "tools/benchmark_lookup.h"
#include "tools/benchmark_process.h"
#include "tools/benchmark_questions.h"

namespace {

struct Options {
  std::optional<std::string> database;
  int queries = 150;
  int runs = 41;
  std::uint64_t seed = 1;
  std::string only;
};

std::string table(const std::string& title, const std::vector<voussoir::Timing>& timings) {
  std::string text = fmt::format("{:<50} {:>12} {:>10}\n", title, "median [ms]", "p95 [ms]");
  for (const auto& timing : timings)
    text += fmt::format("  {:<48} {:>12.3f} {:>10.3f}\n", timing.name, timing.median, timing.p95);
  return text + "\n";
}

std::string benchmark(const Options& options) {
  const auto database = voussoir::Database::open(voussoir::find_database(options.database));
  const std::string questions = "Whole answers, with the model's own error";
  if (!options.only.empty())
    return table(questions, voussoir::time_questions(database, options.queries, options.seed, options.only));
  const voussoir::Library library = voussoir::library_of(database);
  const auto timings = voussoir::time_lookups(library, options.queries, options.seed);
  std::string text = fmt::format("{} queries, {} scenes, {} points\n\n", options.queries,
                                 database.table().rows, database.table().points);
  text += table("Ten best under Eq. 1", timings.searches);
  text += table("Posterior over all scenes", timings.posteriors);
  text += table(questions, voussoir::time_questions(database, options.queries, options.seed));
  text += table("Genetic search, the paper's settings", timings.genetic);
  const auto own_folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  text +=
      table("Whole process, warm cache",
            voussoir::time_processes(own_folder / "locate-damage", database.path(), library, options.runs));
  for (const auto& timing : timings.searches)
    text += fmt::format("{:<30} {:>6.1f} times the search index's median\n", timing.name,
                        timing.median / timings.searches[1].median);
  return text + fmt::format(
                    "\nFast searches that differ from the scan: {}\nLargest difference of a screened "
                    "probability: {:.1e}\n",
                    timings.disagreements, timings.largest_difference);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Measures how fast lookups are, in process on one core and as whole processes.",
               "benchmark-lookup");
  app.footer("Example: benchmark-lookup -d bridge.h5");
  Options options;
  app.add_option("-d,--database", options.database, "default: $VOUSSOIR_DATABASE, else ./bridge.h5");
  app.add_option("--queries", options.queries, "default 150")->check(CLI::Range(3, 1000000));
  app.add_option("--runs", options.runs, "of whole processes, default 41")->check(CLI::Range(1, 100000));
  app.add_option("--only", options.only, "whole answers to questions whose name contains this, and no more");
  app.add_option("--seed", options.seed, "default 1");
  return voussoir::run_program(app, argc, argv, [&] { return benchmark(options); });
}
