/// @file verify-database: is a database whole and right?

#include "core/program/command_line.h"
#include "generator/verify_options.h"

using namespace voussoir;

namespace {

ProgramOutput verify(const VerifyOptions& options) {
  const VerifyReport report = verify_database(options.request);
  const std::string text = options.json ? to_json(report) : to_text(report, options.request.database);
  return {text, report.ok() ? kDone : kFailed};
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Checks that a database is whole and that what it says is right.", "verify-database");
  VerifyOptions options;
  add_options(app, options);
  return run_program(app, argc, argv, [&] { return verify(options); });
}
