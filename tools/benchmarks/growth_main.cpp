/// @file benchmark-growth: how time and memory grow.

#include <fmt/format.h>

#include <filesystem>
#include <iostream>

#include "core/program/command_line.h"
#include "core/text_file.h"
#include "tools/benchmarks/growth.h"

using namespace voussoir;

namespace {

std::string benchmark(int most_spans, int scenes, const std::string& folder) {
  const auto tell = [](const Growth& growth) {
    const GrowthPoint& point = growth.points.back();
    std::cerr << fmt::format("{} {:.3g}: {:.2f} ms a scene\n", growth.name, point.x, 1e3 * point.seconds);
  };
  std::string text;
  for (const Growth& growth : measure_growth(most_spans, scenes, tell)) {
    text += to_markdown(growth);
    if (!folder.empty()) write_file(std::filesystem::path(folder) / (growth.name + ".svg"), to_svg(growth));
  }
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Processor time and memory of a scene over the number of blocks, the joints' stiffness and the "
      "smallest piece, as tables (Markdown) and pictures (SVG).",
      "benchmark-growth");
  app.footer("Example: benchmark-growth --svg docs/pictures/growth");
  int most_spans = 16;
  int scenes = 0;
  std::string folder;
  app.add_option("--spans", most_spans, "of the longest viaduct; default 16")->check(CLI::Range(1, 64));
  app.add_option("--scenes", scenes, "singles of each bridge with other joints or pieces; default 0: all")
      ->check(CLI::Range(0, 100000));
  app.add_option("--svg", folder, "write the pictures into this folder")->check(CLI::ExistingDirectory);
  return run_program(app, argc, argv, [&] { return benchmark(most_spans, scenes, folder); });
}
