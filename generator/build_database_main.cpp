/// @file build-database: from a bridge file to its database.

#include <csignal>
#include <iostream>

#include "core/error.h"
#include "core/text_file.h"
#include "generator/bridge_drawing.h"
#include "generator/build_options.h"
#include "generator/summary.h"
#include "generator/variants.h"

using namespace voussoir;

namespace {

int run(BuildOptions options) {
  options.request.bridge = options.bridge ? read_bridge_file(*options.bridge) : reference_bridge_file();
  if (!options.quiet)
    for (const std::string& note : options.request.bridge.notes)
      std::cerr << "build-database: " << options.request.bridge.name << ": " << note << '\n';
  const BridgeDescription& description = options.request.bridge.description;
  if (options.drawing) {
    write_file(*options.drawing, bridge_drawing(make_model(description), description));
    return 0;
  }
  if (options.variants > 0)
    options.request.other_variants = sampled_variants(make_model(description), description.uncertainty,
                                                      options.variants, options.variant_seed);
  if (options.version) {
    std::cout << version_text("build-database") << '\n'
              << describe(provenance_of(options.request, options.solver));
    return std::cout.flush() ? 0 : 1;
  }
  Progress progress(options.quiet ? Progress::Mode::quiet : Progress::Mode::automatic);
  const BuildSummary summary = build_database(options.request, options.solver, progress);
  std::cout << (options.json ? to_json(summary) : to_text(summary)) << std::flush;
  return std::cout ? 0 : 1;
}

/// For people on stderr; for schedulers, with --format json, also as a line on stdout.
int fail(const std::string& message, bool json, int exit_code) {
  std::cerr << "build-database: " << message << '\n';
  if (json) std::cout << failure_to_json(message);
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file size limit shows as an error of write(), as a full disk does
  bool json = false;
  try {
    BuildOptions options = parse_build_options(argc, argv);
    json = options.json;
    return options.exit_code ? *options.exit_code : run(std::move(options));
  } catch (const InputError& error) {
    return fail(error.what(), json, 2);
  } catch (const std::exception& error) {
    return fail(error.what(), json, 1);
  }
}
