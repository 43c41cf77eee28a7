#pragma once
/// @file What programs say of an error to other programs: whoever asks for JSON gets JSON, whatever happens.

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace voussoir {

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
  const nlohmann::ordered_json json = {{"ok", false}, {"error", message}};
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace voussoir
