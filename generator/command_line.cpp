#include "generator/command_line.h"

#include <iostream>

#include "core/decimal_options.h"
#include "core/error.h"
#include "core/program_failure.h"

namespace voussoir {
namespace {

constexpr int kMostThreads = 4096;

}  // namespace

std::optional<int> parse_command_line(CLI::App& app, int argc, char** argv) {
  expect_decimal_numbers(app);
  try {
    app.parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    const std::string& name = app.get_name();
    return fail(name, fmt::format("{} (see {} --help)", error.what(), name), asks_for_json(argc, argv),
                kBadInput);
  }
}

void add_threads_option(CLI::App& app, int& threads) {
  app.add_option("--threads", threads, "threads, 0: one for each core")
      ->check(CLI::Range(0, kMostThreads))
      ->capture_default_str();
}

void add_format_option(CLI::App& app, bool& json, const std::string& of_what) {
  app.add_option_function<std::string>(
         "--format", [&json](const std::string& format) { json = format == "json"; }, of_what)
      ->check(CLI::IsMember({"text", "json"}))
      ->default_str("text");
}

void say(const std::string& answer) {
  if (!(std::cout << answer << std::flush))
    throw Failure("the answer cannot be written to the standard output");
}

}  // namespace voussoir
