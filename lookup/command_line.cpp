#include "lookup/command_line.h"

#include <cstdlib>

#include "core/error.h"
#include "core/solve/state_name.h"
#include "lookup/readings/millimetres.h"

namespace voussoir {

void add_database_option(CLI::App& app, std::optional<std::string>& database) {
  app.add_option("-d,--database", database, "default: $VOUSSOIR_DATABASE, else ./bridge.h5")
      ->option_text("FILE");
}

void add_history_option(CLI::App& app, std::optional<std::string>& history, const std::string& description) {
  add_choice<std::optional<std::string>>(app, "--history", history,
                                         {{kBuiltState, kBuiltState}, {kLostState, kLostState}}, description);
}

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

std::vector<std::filesystem::path> find_databases(const std::vector<std::string>& given) {
  if (given.empty()) return {find_database(std::nullopt)};
  return {given.begin(), given.end()};
}

CLI::Option* add_millimetres(CLI::App& app, const std::string& names, double& metres,
                             const std::string& description, std::string_view unit) {
  constexpr double kMost = 1e6;  // beyond it nothing is known at all
  const auto parse = [unit](std::string_view text) { return parse_millimetres(text, 0.0, kMost, unit); };
  return add_parsed(app, names, metres, parse, unit == "mm" ? "MM" : "MM/M", description);
}

}  // namespace voussoir
