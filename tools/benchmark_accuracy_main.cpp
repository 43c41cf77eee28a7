/// @file benchmark-accuracy: run time against error of the solvers.

#include <CLI/CLI.hpp>
#include <fstream>
#include <iostream>

#include "core/bridge_file.h"
#include "core/error.h"
#include "tools/benchmark_accuracy.h"
#include "tools/benchmark_skips.h"

int main(int argc, char** argv) {
  using namespace voussoir;
  CLI::App app{"Run time against error of the solvers, as a table (Markdown) and a plot (SVG)",
               "benchmark-accuracy"};
  AccuracyOptions options;
  std::string bridge_file;
  std::string plot;
  bool skips = false;
  std::string skip_scenes = "singles;10,*+12,*;8,*+4,10;0,3+1,*;0,5+3,*";
  app.add_option("bridge", bridge_file, "bridge file; the reference bridge without");
  app.add_option("--scenes", options.scenes, "scenes that stand, such as 10,4 4,10+2,6")->delimiter(' ');
  app.add_option("--reference-refinement", options.reference_refinement, "levels of the reference's mesh")
      ->check(CLI::Range(0, 3));
  app.add_flag("--plain", options.plain, "also plain central differences (minutes)");
  app.add_flag("--skips", skips, "what each skip of a build gains and changes, instead");
  app.add_option("--skip-scenes", skip_scenes,
                 "scenes built for that, as --scenes of build-database takes them")
      ->capture_default_str();
  app.add_option("--svg", plot, "write the plot to this file");
  CLI11_PARSE(app, argc, argv);
  try {
    const BridgeFile bridge = bridge_file.empty() ? reference_bridge_file() : read_bridge_file(bridge_file);
    if (skips) {
      std::cout << to_markdown(measure_skips(bridge, skip_scenes));
      return 0;
    }
    const std::vector<AccuracyRow> rows = measure_accuracy(bridge.description, options);
    std::cout << to_markdown(rows);
    if (!plot.empty() && !(std::ofstream(plot) << to_svg(rows)))
      throw Failure(fmt::format("{}: cannot be written", plot));
    return 0;
  } catch (const InputError& error) {
    std::cerr << "benchmark-accuracy: " << error.what() << '\n';
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "benchmark-accuracy: " << error.what() << '\n';
    return 1;
  }
}
