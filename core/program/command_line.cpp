#include "core/program/command_line.h"

#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string_view>

#include "core/error.h"
#include "core/json_text.h"
#include "core/program/heap.h"
#include "core/program/process.h"
#include "core/random.h"
#include "core/text.h"

namespace voussoir {
namespace {

/// Does a command line have --format json? Asked where it may be wrong in all else.
bool asks_for_json(int argc, const char* const* argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (argument == "--format=json") return true;
    if (argument == "--format" && i + 1 < argc && std::string_view(argv[i + 1]) == "json") return true;
  }
  return false;
}

/// CLI11 takes 010 for eight and 0x10 for sixteen: such texts are refused for all options that take whole
/// numbers.
void expect_decimal_numbers(CLI::App& app) {
  for (CLI::Option* const option : app.get_options()) {
    if (!option->get_type_name().starts_with("INT") && !option->get_type_name().starts_with("UINT")) continue;
    option->check([](const std::string& text) {
      const std::size_t first = text.find_first_not_of("+-");
      const bool is_octal = first != std::string::npos && text[first] == '0' && first + 1 < text.size();
      return is_octal ? in_quotes(text) + " given, expected a decimal number without zeros before it" : "";
    });
  }
}

void complain(const std::string& name, const std::string& message) {
  std::fputs(fmt::format("{}: {}\n", name, message).c_str(), stderr);
}

void write_out(const std::string& text) {
  const bool written =
      std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
  if (!written) throw Failure("the answer cannot be written to the standard output");
}

/// Ends the process at once: the system takes memory and files back faster than the libraries' exit handlers
/// give them back one by one.
[[noreturn]] void leave(int code) {
  std::fflush(nullptr);
  std::_Exit(code);
}

/// What the program says to its command line, were it only --help or --version.
ProgramOutput output_of(CLI::App& app, int argc, char** argv, const std::function<ProgramOutput()>& program) {
  expect_decimal_numbers(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0)
      throw InputError(fmt::format("{} (see {} --help)", error.what(), app.get_name()));
    std::ostringstream text;
    app.exit(error, text);
    return text.str();
  }
  return program();
}

}  // namespace

int run_program(CLI::App& app, int argc, char** argv, const std::function<ProgramOutput()>& program) {
  prepare_heap();
  prepare_process();
  const auto fail = [&](const char* message, int exit_code) {
    complain(app.get_name(), message);
    if (asks_for_json(argc, argv)) std::fputs(json_text({{"ok", false}, {"error", message}}).c_str(), stdout);
    return exit_code;
  };
  try {
    const ProgramOutput output = output_of(app, argc, argv, program);
    write_out(output.text);
    if (!output.complaint.empty()) complain(app.get_name(), output.complaint);
    leave(output.exit_code);
  } catch (const InputError& error) {
    return fail(error.what(), kBadInput);
  } catch (const std::exception& error) {
    return fail(error.what(), kFailed);
  }
}

CLI::Validator number_in_range(double least, double most, const std::string& name) {
  return checked_by(
      [=](std::string_view text) {
        const std::optional<double> number = parse_number(text);
        if (!number || *number < least || *number > most)
          throw InputError(
              fmt::format("{} given, expected a number from {:g} to {:g}", in_quotes(text), least, most));
      },
      name);
}

void add_threads_option(CLI::App& app, int& threads) {
  constexpr int kMost = 4096;
  app.add_option("--threads", threads, "how many threads, default 0: one for each core")
      ->check(CLI::Range(0, kMost))
      ->option_text("N");
}

void add_format_option(CLI::App& app, bool& json, const std::string& of_what) {
  add_choice<bool>(app, "--format", json, {{"text", false}, {"json", true}},
                   of_what + ": text (default) or json");
}

void add_seed_option(CLI::App& app, std::uint64_t& seed, const std::string& of_what) {
  app.add_option("--seed", seed, of_what)
      ->check(CLI::Range(std::uint64_t{0}, kLargestSeed))
      ->option_text("N");
}

}  // namespace voussoir
