#include "lookup/readings/reading_states.h"

#include <algorithm>
#include <variant>

#include "core/error.h"
#include "core/solve/state_name.h"
#include "core/text.h"

namespace voussoir {
namespace {

/// The load cases after a history, for messages.
std::string loads_of(const Database& database, const std::string& history) {
  std::string names;
  for (const std::string& state : database.states())
    if (history_of(state) == history && !is_history(state))
      names += (names.empty() ? "" : ", ") + std::string(load_stage_of(state));
  return names.empty() ? "a database built with load cases (build-database --loads)" : "one of " + names;
}

/// The states of one history; a message instead of what is missing.
std::variant<ReadingStates, std::string> states_of(const ReadingsFile& file, const Database& database,
                                                   const std::string& history) {
  const std::optional<std::size_t> base = database.find_state(history);
  if (!base)
    return at_line(database.path().string(), 0,
                   fmt::format("has no history '{}' but the states {}; expected one built with --history {}",
                               history, fmt::join(database.states(), ", "), history));
  ReadingStates states{history, *base, {}};
  for (const Reading& reading : file.readings) {
    states.loaded.push_back(std::nullopt);
    if (reading.load.empty()) continue;
    states.loaded.back() = database.find_state(state_name(history, reading.load));
    if (!states.loaded.back())
      return at_line(file.name, reading.line,
                     fmt::format("the database has no load {} after the history '{}', expected {}",
                                 in_quotes(reading.load), history, loads_of(database, history)));
  }
  return states;
}

}  // namespace

ReadingStates find_reading_states(const ReadingsFile& file, const Database& database,
                                  const std::optional<std::string>& history) {
  const bool absolute = file.kind == ReadingKind::absolute;
  const std::string usual = history.value_or(absolute ? kBuiltState : kLostState);
  auto found = states_of(file, database, usual);
  if (!history && std::holds_alternative<std::string>(found)) {
    auto other = states_of(file, database, absolute ? kLostState : kBuiltState);
    if (std::holds_alternative<ReadingStates>(other) || !database.find_state(usual)) found = std::move(other);
  }
  if (const auto* const message = std::get_if<std::string>(&found)) throw InputError(*message);
  return std::get<ReadingStates>(std::move(found));
}

}  // namespace voussoir
