/// @file merge-databases: from the parts of a database to the whole.

#include <csignal>
#include <iostream>

#include "core/error.h"
#include "generator/merge_options.h"
#include "generator/summary.h"

using namespace voussoir;

namespace {

int run(const MergeOptions& options) {
  Progress progress(options.quiet ? Progress::Mode::quiet : Progress::Mode::automatic);
  const BuildSummary summary = merge_databases(
      options.request, [](const std::string& settings) { return solver_with(parse_settings(settings)); },
      progress);
  std::cout << (options.json ? to_json(summary) : to_text(summary)) << std::flush;
  return std::cout ? 0 : 1;
}

int fail(const std::string& message, bool json, int exit_code) {
  std::cerr << "merge-databases: " << message << '\n';
  if (json) std::cout << failure_to_json(message);
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file size limit shows as an error of write(), as a full disk does
  bool json = false;
  try {
    const MergeOptions options = parse_merge_options(argc, argv);
    json = options.json;
    return options.exit_code ? *options.exit_code : run(options);
  } catch (const InputError& error) {
    return fail(error.what(), json, 2);
  } catch (const std::exception& error) {
    return fail(error.what(), json, 1);
  }
}
