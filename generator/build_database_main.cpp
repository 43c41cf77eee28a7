/// @file build-database: from a bridge file to its database.

#include <iostream>

#include "core/bridge_file/bridge_model.h"
#include "core/heap.h"
#include "core/program_failure.h"
#include "core/text_file.h"
#include "generator/bridge_drawing.h"
#include "generator/build_options.h"
#include "generator/command_line.h"
#include "generator/scenes/variants.h"
#include "generator/summary.h"

using namespace voussoir;

namespace {

void note(const BridgeFile& file, const std::vector<std::string>& notes) {
  for (const std::string& one : notes) std::cerr << "build-database: " << file.name << ": " << one << '\n';
}

int run(BuildOptions& options) {
  options.request.bridge = options.bridge ? read_bridge_file(*options.bridge) : reference_bridge_file();
  if (!options.quiet) note(options.request.bridge, options.request.bridge.notes);
  const BridgeDescription& description = options.request.bridge.description;
  const Model bridge = model_of(options.request.bridge);
  if (!options.quiet) note(options.request.bridge, without_effect(description, bridge));
  if (options.drawing) {
    check_output("--draw", *options.drawing, {".svg"});
    write_file(*options.drawing, bridge_drawing(bridge, description));
    return 0;
  }
  const SolverChoice solver = settle_collapses(bridge, options);
  if (options.variants > 0)
    options.request.other_variants =
        sampled_variants(bridge, description.uncertainty, options.variants, options.variant_seed);
  if (options.version) {
    say(version_text("build-database") + "\n" + describe(provenance_of(options.request, solver)));
    return 0;
  }
  Progress progress(options.quiet ? Progress::Mode::quiet : Progress::Mode::automatic);
  if (!options.collapse_fields && description.collapse_fields && !options.request.rules.collapse_fields)
    progress.say(
        "of scenes that fall only that and what falls is kept: motion follows softer joints than these, of "
        "which fields would be (--collapses field keeps them)");
  const BuildSummary summary = build_database(options.request, solver, progress);
  say(options.json ? to_json(summary) : to_text(summary));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  keep_freed_memory();
  BuildOptions options;
  return exit_code_of("build-database", asks_for_json(argc, argv), [&] {
    parse_build_options(argc, argv, options);
    return options.exit_code ? *options.exit_code : run(options);
  });
}
