#pragma once
/// @file How programs end that could not do what they were asked: what they say, to people and to other
/// programs (whoever asks for JSON gets JSON, whatever happens), and exit codes.

#include <cstdio>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/json_text.h"
#include "core/process.h"

namespace voussoir {

inline constexpr int kFailed = 1;    ///< could not be done
inline constexpr int kBadInput = 2;  ///< bad usage or bad input

/// Does a command line have --format json? Asked where it may be wrong in all else.
inline bool asks_for_json(int argc, const char* const* argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (argument == "--format=json") return true;
    if (argument == "--format" && i + 1 < argc && std::string_view(argv[i + 1]) == "json") return true;
  }
  return false;
}

/// One line: {"ok": false, "error": ...}.
inline std::string failure_to_json(const std::string& message) {
  return json_text({{"ok", false}, {"error", message}});
}

/// Says what is wrong on the standard error and, with `json`, on the standard output. The exit code.
inline int fail(const std::string& name, const std::string& message, bool json, int exit_code) {
  std::fputs(fmt::format("{}: {}\n", name, message).c_str(), stderr);
  if (json) std::fputs(failure_to_json(message).c_str(), stdout);
  return exit_code;
}

/// The program's own exit code, or that of what it throws, which becomes a message for people on the standard
/// error and, with `json`, a line for schedulers on the standard output.
template <class Program>
int exit_code_of(const std::string& name, bool json, const Program& program) {
  prepare_process();
  try {
    return program();
  } catch (const InputError& error) {
    return fail(name, error.what(), json, kBadInput);
  } catch (const std::exception& error) {
    return fail(name, error.what(), json, kFailed);
  }
}

}  // namespace voussoir
