/// @file build-database: from a bridge file to its database.

#include <iostream>

#include "core/bridge_file/bridge_model.h"
#include "core/program/command_line.h"
#include "core/text_file.h"
#include "generator/bridge_drawing.h"
#include "generator/build_options.h"
#include "generator/scenes/variants.h"
#include "generator/summary.h"

using namespace voussoir;

namespace {

void note(const BridgeFile& file, const std::vector<std::string>& notes) {
  for (const std::string& one : notes) std::cerr << "build-database: " << file.name << ": " << one << '\n';
}

std::string build(BuildOptions options) {
  options.request.bridge = options.bridge ? read_bridge_file(*options.bridge) : reference_bridge_file();
  if (!options.quiet) note(options.request.bridge, options.request.bridge.notes);
  const BridgeDescription& description = options.request.bridge.description;
  const Model bridge = model_of(options.request.bridge);
  if (!options.quiet) note(options.request.bridge, without_effect(description, bridge));
  if (options.drawing) {
    check_output("--draw", *options.drawing, {".svg"});
    write_file(*options.drawing, bridge_drawing(bridge, description));
    return {};
  }
  const SolverChoice solver = settle_collapses(bridge, options);
  if (options.variants > 0)
    options.request.other_variants =
        sampled_variants(bridge, description.uncertainty, options.variants, options.variant_seed);
  if (options.version)
    return version_text("build-database") + "\n" + describe(provenance_of(options.request, solver));
  Progress progress(options.quiet ? Progress::Mode::quiet : Progress::Mode::automatic);
  if (!options.collapse_fields && description.collapse_fields && !options.request.rules.collapse_fields)
    progress.say(
        "of scenes that fall only that and what falls is kept: motion follows softer joints than these, of "
        "which fields would be (--collapses field keeps them)");
  const BuildSummary summary = build_database(options.request, solver, progress);
  return options.json ? to_json(summary) : to_text(summary);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Computes the database of a bridge: the displacements of every scene with missing blocks.",
               "build-database");
  BuildOptions options;
  add_options(app, options);
  return run_program(app, argc, argv, [&] { return build(finished(options)); });
}
