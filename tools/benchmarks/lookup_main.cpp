/// @file benchmark-lookup: how fast lookups are, in process and as whole processes.

#include "core/error.h"
#include "lookup/command_line.h"
#include "tools/benchmarks/lookup.h"
#include "tools/benchmarks/process.h"
#include "tools/benchmarks/questions.h"
#include "tools/benchmarks/triples_library.h"

using namespace voussoir;

namespace {

struct Options {
  std::optional<std::string> database;
  LookupQueries queries;
  int runs = 41;
  bool triples = false, searches = false;
  std::string only;
};

std::string table(const std::string& title, const std::vector<Timing>& timings) {
  std::string text = fmt::format("{:<50} {:>12} {:>10}\n", title, "median [ms]", "p95 [ms]");
  for (const auto& timing : timings)
    text += fmt::format("  {:<48} {:>12.3f} {:>10.3f}\n", timing.name, timing.median, timing.p95);
  return text + "\n";
}

std::string questions(const Options& options, const Database& database, const Library& library) {
  if (options.searches) return {};
  const LookupQueries& asked = options.queries;
  std::string text =
      fmt::format("{:<50} {:>12} {:>10} {:>16} {:>10}\n", "Whole answers, with the model's own error",
                  "median [ms]", "p95 [ms]", "processors [ms]", "p95 [ms]");
  for (const auto& [wall, processors] :
       time_questions(database, library, asked.count, asked.seed, options.only))
    text += fmt::format("  {:<48} {:>12.3f} {:>10.3f} {:>16.3f} {:>10.3f}\n", wall.name, wall.median,
                        wall.p95, processors.median, processors.p95);
  return text + "\n";
}

std::string head(const Options& options, const SceneTable& table) {
  return fmt::format("{} queries, {} scenes, {} points\n\n", options.queries.count, table.rows, table.points);
}

std::string differences(const LookupTimings& timings) {
  return fmt::format("Fast searches that differ from the scan: {}\n", timings.disagreements);
}

std::string benchmark_triples(const Options& options, const Database& database) {
  const TriplesLibrary triples(library_of(database));
  const Library& library = triples.library();
  std::string text = head(options, library.table);
  text += fmt::format("Search index: {:.1f} s of processor time\n\n", triples.seconds_of_index());
  if (options.only.empty()) {
    const auto timings = time_lookups_of_triples(library, options.queries);
    text += table("Ten best under Eq. 1", timings.searches);
    text += table("Posterior over all scenes", timings.posteriors) + differences(timings) + "\n";
  }
  return text + questions(options, database, library);
}

std::string benchmark(const Options& options) {
  const auto database = Database::open(find_database(options.database));
  if (options.triples) return benchmark_triples(options, database);
  const Library library = library_of(database);
  if (!options.only.empty()) return questions(options, database, library);
  const auto timings = time_lookups(library, options.queries);
  std::string text = head(options, library.table);
  text += table("Ten best under Eq. 1", timings.searches);
  text += table("Posterior over all scenes", timings.posteriors);
  text += questions(options, database, library);
  text += table("Genetic search, the paper's settings", timings.genetic);
  if (!options.searches) {
    const auto own_folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
    text += table("Whole process, warm cache",
                  time_processes(own_folder / "locate-damage", database.path(), library, options.runs));
  }
  for (const auto& timing : timings.searches)
    text += fmt::format("{:<30} {:>6.1f} times the search index's median\n", timing.name,
                        timing.median / timings.searches[1].median);
  return text + "\n" + differences(timings) +
         fmt::format("Largest difference of a screened probability: {:.1e}\n", timings.largest_difference);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Measures how fast lookups are, in process and as whole processes.", "benchmark-lookup");
  app.footer("Example: benchmark-lookup -d bridge.h5");
  Options options;
  add_database_option(app, options.database);
  app.add_option("--queries", options.queries.count, "default 150")->check(CLI::Range(3, 1000000));
  app.add_option("--runs", options.runs, "of whole processes, default 41")->check(CLI::Range(1, 100000));
  app.add_option("--only", options.only, "whole answers to questions whose name contains this, and no more");
  app.add_flag("--searches", options.searches, "searches and posteriors alone, no whole answers")
      ->excludes("--only");
  app.add_option("--level", options.queries.level,
                 "of the noise of all queries; default: even from 0.01 to 0.1")
      ->check(CLI::Range(1e-4, 1.0));
  add_seed_option(app, options.queries.seed, "default 1");
  app.add_flag(
      "--triples", options.triples,
      "of all scenes with up to three missing blocks, made up from the database's singles and pairs (3 GB "
      "of memory)");
  return run_program(app, argc, argv, [&] { return benchmark(options); });
}
