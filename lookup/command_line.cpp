#include "lookup/command_line.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "core/decimal_options.h"
#include "core/error.h"
#include "core/heap.h"
#include "core/program_failure.h"
#include "core/text.h"
#include "lookup/readings/millimetres.h"

namespace voussoir {
namespace {

/// A short-lived program gains little from getting pages one by one: the heap begins where a large page may
/// begin and grows at once to what a lookup needs, in large pages where there are any.
void prepare_heap() {
  keep_freed_memory();
#if defined(__GLIBC__) && defined(MADV_HUGEPAGE)
  constexpr std::size_t kRoom = 64 << 20;
  constexpr std::uintptr_t kLargePage = 2 << 20, kSmallPage = 4 << 10;
  const auto so_far = reinterpret_cast<std::uintptr_t>(::sbrk(0));
  const std::uintptr_t to_large = kLargePage - (so_far + kSmallPage) % kLargePage;
  static_cast<void>(::sbrk(static_cast<std::intptr_t>(to_large)));
  char* const room = static_cast<char*>(std::malloc(kRoom));
  if (room != nullptr) {
    // What malloc notes before the room is in a small page, and would make small ones of the first large
    // page.
    char* const large = room + (kLargePage - reinterpret_cast<std::uintptr_t>(room) % kLargePage);
    static_cast<void>(::madvise(large, kRoom - kLargePage, MADV_HUGEPAGE));
  }
  std::free(room);
#endif
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

}  // namespace

std::filesystem::path find_database(const std::optional<std::string>& given) {
  if (given) return *given;
  const char* const named = std::getenv("VOUSSOIR_DATABASE");
  if (named != nullptr && *named != '\0') return named;
  const std::filesystem::path usual = "bridge.h5";
  if (std::filesystem::exists(usual)) return usual;
  throw Failure(
      "no database: there is no ./bridge.h5, and neither -d nor $VOUSSOIR_DATABASE names one; "
      "build one with: build-database -o bridge.h5");
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

CLI::Option* add_millimetres(CLI::App& app, const std::string& names, double& metres,
                             const std::string& description, std::string_view unit) {
  constexpr double kMost = 1e6;  // beyond it nothing is known at all
  const auto parse = [unit](std::string_view text) { return parse_millimetres(text, 0.0, kMost, unit); };
  const std::string shown = unit == "mm" ? "MM" : "MM/M";
  return app
      .add_option_function<std::string>(
          names, [&metres, parse](const std::string& text) { metres = parse(text); }, description)
      ->check(checked_by(parse, shown))
      ->option_text(shown);
}

void share_heap() {
#ifdef __GLIBC__
  mallopt(M_ARENA_MAX, 1);
#endif
}

int run_program(CLI::App& app, int argc, char** argv, const std::function<ProgramOutput()>& program) {
  prepare_heap();
  const std::string& name = app.get_name();
  const bool json = asks_for_json(argc, argv);
  expect_decimal_numbers(app);
  return exit_code_of(name, json, [&] {
    try {
      app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
      return fail(name, fmt::format("{} (see {} --help)", error.what(), name), json, kBadInput);
    }
    const ProgramOutput output = program();
    write_out(output.text);
    if (output.complaint.empty()) leave(0);
    leave(fail(name, output.complaint, false, kFailed));
  });
}

}  // namespace voussoir
