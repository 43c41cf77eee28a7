#pragma once
/// @file JSON as programs write it.

#include <nlohmann/json.hpp>
#include <string>

namespace voussoir {

/// A line, or with an indent lines. Bytes that are no UTF-8, as names of files may have, are replaced: one
/// such name must not cost the answer.
inline std::string json_text(const nlohmann::ordered_json& json, int indent = -1) {
  return json.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace voussoir
