/// @file benchmark-bridges: random plausible bridges beside the reference bridge.

#include <fmt/format.h>

#include <filesystem>
#include <iostream>

#include "core/program/command_line.h"
#include "core/text_file.h"
#include "tools/benchmarks/bridges.h"
#include "tools/validation/random_bridge.h"

using namespace voussoir;

namespace {

/// Bridge files FOLDER/SEED.toml, for build-database. Returns what was written, a line each.
std::string write_bridges(const BridgeOptions& options, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  std::string written;
  for (int i = 0; i < options.bridges; ++i) {
    const std::uint64_t seed = options.seed + static_cast<std::uint64_t>(i);
    const std::filesystem::path file = folder / fmt::format("{}.toml", seed);
    write_file(file, bridge_file_text(random_bridge(seed)));
    written += file.string() + "\n";
  }
  return written;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Solves intact and singles of random plausible bridges on one thread, and tables their outcomes and "
      "the processor time beside the reference bridge's (Markdown), as it would be with all singles.",
      "benchmark-bridges");
  app.footer(
      "Examples: benchmark-bridges --bridges 20 --seed 100\n"
      "          benchmark-bridges --bridges 20 --seed 100 --write bridges");
  BridgeOptions options;
  app.add_option("--bridges", options.bridges, "default 10")->check(CLI::Range(0, 100000));
  add_seed_option(app, options.seed, "of the first bridge, the next has the next one; default 1");
  app.add_option("--scenes", options.scenes, "singles drawn of each bridge, 0: all; default 40")
      ->check(CLI::Range(0, 100000));
  app.add_option(
         "--follow", options.most_followed,
         "scenes of bridges of at most so many blocks are followed in plain explicit motion, too, which "
         "takes minutes a bridge; default 0")
      ->check(CLI::Range(0, 100000));
  std::string folder;
  app.add_option("--write", folder, "only write the bridges' files, FOLDER/SEED.toml, for build-database")
      ->type_name("FOLDER");
  return run_program(app, argc, argv, [&] {
    if (!folder.empty()) return write_bridges(options, folder);
    const auto tell = [](const BridgeRow& row) {
      std::cerr << fmt::format("{}: {} blocks, {:.1f} s\n", row.name, row.blocks, row.intact + row.singles);
    };
    return to_markdown(measure_bridges(options, tell));
  });
}
