/// @file build-database: from a bridge file to its database.

#include <csignal>
#include <iostream>

#include "core/error.h"
#include "generator/build_options.h"
#include "generator/summary.h"

using namespace voussoir;

namespace {

int run(BuildOptions options) {
  options.request.bridge = options.bridge ? read_bridge_file(*options.bridge) : reference_bridge_file();
  Progress progress(options.quiet ? Progress::Mode::quiet : Progress::Mode::automatic);
  const BuildSummary summary = build_database(options.request, options.solver, progress);
  std::cout << (options.json ? to_json(summary) : to_text(summary)) << std::flush;
  return std::cout ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file size limit shows as an error of write(), as a full disk does
  try {
    BuildOptions options = parse_build_options(argc, argv);
    return options.exit_code ? *options.exit_code : run(std::move(options));
  } catch (const InputError& error) {
    std::cerr << "build-database: " << error.what() << '\n';
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "build-database: " << error.what() << '\n';
    return 1;
  }
}
