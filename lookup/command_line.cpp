#include "lookup/command_line.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "core/error.h"

namespace voussoir {
namespace {

constexpr int kDone = 0;
constexpr int kFailed = 1;
constexpr int kBadInput = 2;

int complain(const CLI::App& app, const std::exception& error, int code) {
  fmt::print(stderr, "{}: {}\n", app.get_name(), error.what());
  return code;
}

/// A short-lived program gains nothing from giving pages back to the system only to ask for them again.
void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int kNever = 1 << 30;
  mallopt(M_MMAP_THRESHOLD, kNever);
  mallopt(M_TRIM_THRESHOLD, kNever);
  mallopt(M_TOP_PAD, 1 << 20);
#endif
}

void write_out(const std::string& text) {
  const bool written =
      std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
  if (!written) throw Failure("the answer cannot be written to the standard output");
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

void expect_whole_table(const SceneTable& table) {
#ifdef MADV_POPULATE_READ
  const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
  const auto begin = reinterpret_cast<std::uintptr_t>(table.vertical.data()) / page * page;
  const auto end = reinterpret_cast<std::uintptr_t>(table.vertical.data() + table.vertical.size());
  static_cast<void>(::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_POPULATE_READ));
#else
  static_cast<void>(table);
#endif
}

void write_file(const std::filesystem::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  if (!(stream << text && stream.flush())) throw Failure(fmt::format("{}: cannot be written", file.string()));
}

int run_program(CLI::App& app, int argc, char** argv, const std::function<std::string()>& program) {
  keep_freed_memory();
  try {
    app.parse(argc, argv);
    write_out(program());
    return kDone;
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    fmt::print(stderr, "{}: {} (see {} --help)\n", app.get_name(), error.what(), app.get_name());
    return kBadInput;
  } catch (const InputError& error) {
    return complain(app, error, kBadInput);
  } catch (const std::exception& error) {
    return complain(app, error, kFailed);
  }
}

}  // namespace voussoir
