/// @file benchmark-assumptions: what databases say of an intact bridge that is not built as their files say.

#include <iostream>

#include "lookup/command_line.h"
#include "lookup/readings/stated_sigmas.h"
#include "tools/benchmarks/assumptions.h"

int main(int argc, char** argv) {
  CLI::App app(
      "Solves intact bridges as they may be in truth, warms and moves them, reads their control points, and "
      "tables (Markdown) how often databases that assume something else call them damaged: each database by "
      "itself and, if there are several, all together as locate-damage asks them.",
      "benchmark-assumptions");
  app.footer(
      "Examples: benchmark-assumptions ends-held.toml -d ends-slide.h5\n"
      "          benchmark-assumptions ends-slide.toml ends-held.toml -d ends-slide.h5 -d ends-held.h5");
  voussoir::AssumptionOptions options;
  app.add_option("BRIDGE", options.bridges, "bridge files: the bridge as it may be in truth")
      ->required()
      ->option_text("BRIDGE.toml..");
  app.add_option("-d,--database", options.databases,
                 "may come several times; default: $VOUSSOIR_DATABASE, else ./bridge.h5");
  app.add_option_function<std::string>(
         "--sigma", [&](const std::string& text) { options.sigma = voussoir::parse_sigma(text); },
         "standard deviation of every reading, default 0.01mm")
      ->check(voussoir::checked_by(voussoir::parse_sigma, "MM"))
      ->option_text("MM");
  app.add_option("--questions", options.questions, "of each kind, each with errors of its own; default 4")
      ->check(CLI::Range(1, 1000000));
  app.add_option(
      "--shift", options.shift,
      "how much further right the bridges lie than the databases' [m], for walls that go on at the "
      "left; default 0");
  app.add_option("--seed", options.seed, "of the errors, default 1");
  return voussoir::run_program(app, argc, argv, [&] {
    const auto tell = [](const std::vector<voussoir::AssumptionRow>& rows) {
      std::cerr << rows.front().bridge << ": done\n";
    };
    return to_markdown(voussoir::measure_assumptions(options, tell));
  });
}
