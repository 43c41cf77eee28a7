#pragma once
/// @file The names of states in a database: a history, and after it what else acts: "built", "lost:truck@2".

#include <string>
#include <string_view>

namespace voussoir {

/// Gravity on the bridge that was built without the blocks.
inline constexpr char kBuiltState[] = "built";
/// Gravity on the intact bridge, then the blocks are gone.
inline constexpr char kLostState[] = "lost";

/// The name of a history's own state, or of a stage of a load case after it.
inline std::string state_name(std::string_view history, std::string_view load_stage = {}) {
  std::string name(history);
  if (!load_stage.empty()) name.append(":").append(load_stage);
  return name;
}

/// Is it a history's own state, which searches compare readings with and which has a search index?
inline bool is_history(std::string_view state) {
  return state == kBuiltState || state == kLostState;
}

/// "lost" of "lost:truck@2"
inline std::string_view history_of(std::string_view state) {
  return state.substr(0, state.find(':'));
}

/// "truck@2" of "lost:truck@2"; empty for a history's own state.
inline std::string_view load_stage_of(std::string_view state) {
  const std::size_t colon = state.find(':');
  return colon == std::string_view::npos ? std::string_view{} : state.substr(colon + 1);
}

}  // namespace voussoir
