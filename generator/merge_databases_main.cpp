/// @file merge-databases: from the parts of a database to the whole.

#include "core/program/command_line.h"
#include "generator/merge_options.h"
#include "generator/summary.h"

using namespace voussoir;

namespace {

std::string merge(const MergeOptions& options) {
  Progress progress(options.quiet ? Progress::Mode::quiet : Progress::Mode::automatic);
  const BuildSummary summary = merge_databases(
      options.request, [](const std::string& settings) { return solver_with(parse_settings(settings)); },
      progress);
  return options.json ? to_json(summary) : to_text(summary);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Puts the parts of a database together that build-database --shard has computed.",
               "merge-databases");
  MergeOptions options;
  add_options(app, options);
  return run_program(app, argc, argv, [&] { return merge(options); });
}
