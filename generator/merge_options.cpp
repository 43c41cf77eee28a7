#include "generator/merge_options.h"

#include "core/program/command_line.h"
#include "database/records/provenance.h"

namespace voussoir {

void add_options(CLI::App& app, MergeOptions& options) {
  app.footer(
      "Example: build-database -o part1.h5 --shard 1/2 && build-database -o part2.h5 --shard 2/2 &&\n"
      "         merge-databases part1.h5 part2.h5 -o bridge.h5\n\n"
      "The database is the one that a single build gives: same content, same digest. Exit codes: 0 done, 1 "
      "could not be\ndone, 2 bad usage or parts that do not fit together.");
  app.set_version_flag("--version", version_text("merge-databases"));
  app.add_option("parts", options.request.parts, "files that build-database --shard I/N wrote, in any order")
      ->required()
      ->option_text("PART...");
  app.add_option("-o,--output", options.request.output, "database to write, default bridge.h5")
      ->option_text("FILE");
  add_threads_option(app, options.request.threads);
  add_format_option(app, options.json, "of the summary");
  app.add_flag("--force", options.request.force, "build anew even if the file is up to date");
  app.add_flag(
      "--drop", options.request.drop,
      "let scenes, states, fields and sensitivities of an existing file go that the parts do not have");
  app.add_flag("--quiet", options.quiet, "of messages the summary and errors only");
}

}  // namespace voussoir
