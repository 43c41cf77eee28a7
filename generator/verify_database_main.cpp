/// @file verify-database: is a database whole and right?

#include "core/process.h"
#include "core/program_failure.h"
#include "generator/command_line.h"
#include "generator/verify_options.h"

using namespace voussoir;

namespace {

int run(const VerifyOptions& options) {
  const VerifyReport report = verify_database(options.request);
  say(options.json ? to_json(report) : to_text(report, options.request.database));
  return report.ok() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  prepare_process();
  try {
    const VerifyOptions options = parse_verify_options(argc, argv);
    return options.exit_code ? *options.exit_code : run(options);
  } catch (const std::exception& error) {
    return fail("verify-database", error.what(), asks_for_json(argc, argv), kFailed);
  }
}
