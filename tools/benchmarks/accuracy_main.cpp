/// @file benchmark-accuracy: run time against error of the solvers.

#include "core/bridge_file/bridge_file.h"
#include "core/program/command_line.h"
#include "core/text_file.h"
#include "tools/benchmarks/accuracy.h"
#include "tools/benchmarks/skips.h"

using namespace voussoir;

namespace {

struct Options {
  std::string bridge;
  AccuracyOptions accuracy;
  std::string plot;
  bool skips = false;
  std::string skip_scenes = "singles;10,*+12,*;8,*+4,10;0,3+1,*;0,5+3,*";
};

std::string benchmark(const Options& options) {
  const BridgeFile bridge =
      options.bridge.empty() ? reference_bridge_file() : read_bridge_file(options.bridge);
  if (options.skips) return to_markdown(measure_skips(bridge, options.skip_scenes));
  const auto rows = measure_accuracy(bridge.description, options.accuracy);
  if (!options.plot.empty()) write_file(options.plot, to_svg(rows));
  return to_markdown(rows);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Run time against error of the solvers, as a table (Markdown) and a plot (SVG).",
               "benchmark-accuracy");
  app.footer("Example: benchmark-accuracy --plain --svg accuracy.svg");
  Options options;
  app.add_option("bridge", options.bridge, "bridge file; the reference bridge without");
  app.add_option("--scenes", options.accuracy.scenes, "scenes that stand, such as 10,4 4,10+2,6")
      ->delimiter(' ');
  app.add_option("--reference-refinement", options.accuracy.reference_refinement,
                 "levels of the reference's mesh")
      ->check(CLI::Range(0, 3));
  app.add_flag("--plain", options.accuracy.plain, "also plain central differences (minutes)");
  app.add_flag("--skips", options.skips, "what each skip of a build gains and changes, instead");
  app.add_option("--skip-scenes", options.skip_scenes,
                 "scenes built for that, as --scenes of build-database takes them")
      ->capture_default_str();
  app.add_option("--svg", options.plot, "write the plot to this file");
  return run_program(app, argc, argv, [&] { return benchmark(options); });
}
