/// @file benchmark-bridges: random plausible bridges beside the reference bridge.

#include <iostream>

#include "lookup/command_line.h"
#include "tools/benchmark_bridges.h"

int main(int argc, char** argv) {
  CLI::App app(
      "Solves intact and singles of random plausible bridges on one thread, and tables their outcomes and "
      "the processor time beside the reference bridge's (Markdown), as it would be with all singles.",
      "benchmark-bridges");
  app.footer("Example: benchmark-bridges --bridges 20 --seed 100");
  voussoir::BridgeOptions options;
  app.add_option("--bridges", options.bridges, "default 10")->check(CLI::Range(0, 100000));
  app.add_option("--seed", options.seed, "of the first bridge, the next has the next one; default 1");
  app.add_option("--scenes", options.scenes, "singles drawn of each bridge, 0: all; default 40")
      ->check(CLI::Range(0, 100000));
  app.add_option(
         "--follow", options.most_followed,
         "scenes of bridges of at most so many blocks are followed in plain explicit motion, too, which "
         "takes minutes a bridge; default 0")
      ->check(CLI::Range(0, 100000));
  return voussoir::run_program(app, argc, argv, [&] {
    const auto tell = [](const voussoir::BridgeRow& row) {
      std::cerr << fmt::format("{}: {} blocks, {:.1f} s\n", row.name, row.blocks, row.intact + row.singles);
    };
    return to_markdown(voussoir::measure_bridges(options, tell));
  });
}
