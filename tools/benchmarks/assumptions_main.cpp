/// @file benchmark-assumptions: what databases say of an intact bridge that is not built as their files say.

#include <iostream>

#include "lookup/command_line.h"
#include "lookup/readings/stated_sigmas.h"
#include "tools/benchmarks/assumptions.h"

using namespace voussoir;

int main(int argc, char** argv) {
  CLI::App app(
      "Solves intact bridges as they may be in truth, warms and moves them, reads their control points, and "
      "tables (Markdown) how often databases that assume something else call them damaged: each database by "
      "itself and, if there are several, all together as locate-damage asks them.",
      "benchmark-assumptions");
  app.footer(
      "Examples: benchmark-assumptions ends-held.toml -d ends-slide.h5\n"
      "          benchmark-assumptions ends-slide.toml ends-held.toml -d ends-slide.h5 -d ends-held.h5");
  AssumptionOptions options;
  std::vector<std::string> databases;
  app.add_option("BRIDGE", options.bridges, "bridge files: the bridge as it may be in truth")
      ->required()
      ->option_text("BRIDGE.toml..");
  app.add_option("-d,--database", databases,
                 "may come several times; default: $VOUSSOIR_DATABASE, else ./bridge.h5");
  add_parsed(app, "--sigma", options.sigma, parse_sigma, "MM",
             "standard deviation of every reading, default 0.01mm");
  app.add_option("--questions", options.questions, "of each kind, each with errors of its own; default 4")
      ->check(CLI::Range(1, 1000000));
  app.add_option(
      "--shift", options.shift,
      "how much further right the bridges lie than the databases' [m], for walls that go on at the "
      "left; default 0");
  add_seed_option(app, options.seed, "of the errors, default 1");
  return run_program(app, argc, argv, [&] {
    const auto tell = [](const std::vector<AssumptionRow>& rows) {
      std::cerr << rows.front().bridge << ": done\n";
    };
    options.databases = find_databases(databases);
    return to_markdown(measure_assumptions(options, tell));
  });
}
