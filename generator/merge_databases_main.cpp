/// @file merge-databases: from the parts of a database to the whole.

#include "core/program_failure.h"
#include "generator/command_line.h"
#include "generator/merge_options.h"
#include "generator/summary.h"

using namespace voussoir;

namespace {

int run(const MergeOptions& options) {
  Progress progress(options.quiet ? Progress::Mode::quiet : Progress::Mode::automatic);
  const BuildSummary summary = merge_databases(
      options.request, [](const std::string& settings) { return solver_with(parse_settings(settings)); },
      progress);
  say(options.json ? to_json(summary) : to_text(summary));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  MergeOptions options;
  return exit_code_of("merge-databases", asks_for_json(argc, argv), [&] {
    parse_merge_options(argc, argv, options);
    return options.exit_code ? *options.exit_code : run(options);
  });
}
