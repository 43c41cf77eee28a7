#include "generator/verify/origin_check.h"

#include <sstream>

#include "core/text.h"
#include "database/format/sha256.h"
#include "database/records/schema.h"
#include "database/records/stored_bridge.h"
#include "generator/scenes/results_key.h"

namespace voussoir {
namespace {

/// No version of the program tries or divides anything more often than this.
constexpr int kMostOfAnything = 1000;

/// The lines "phase.most_.. = N" whose number is none that solvers could have had.
void check_settings(const std::string& settings, std::vector<std::string>& problems) {
  std::istringstream lines(settings);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t equals = line.find('=');
    if (line.find(".most_") >= equals || equals == std::string::npos) continue;
    const auto number = parse_whole_number(trimmed(std::string_view(line).substr(equals + 1)));
    if (!number || *number < 0 || *number > kMostOfAnything)
      problems.push_back(fmt::format("dataset '{}': {}: expected a number from 0 to {}",
                                     dataset::kSolverSettings, in_quotes(line), kMostOfAnything));
  }
}

/// The key is what the stated origin gives. Another state of the program may have made it of the same in
/// another way, which nobody can check here; unless the key is the one that this very program gives.
bool is_key_right(const Provenance& stated, const BridgeDescription& description) {
  if (stated.results_key == results_key(description, stated)) return true;
  const Provenance own = make_provenance({stated.bridge_name, stated.bridge_text, description, {}},
                                         stated.solver_settings, stated.results_key);
  return !differences(own, stated).empty() && stated.results_key != results_key(description, own);
}

}  // namespace

std::vector<std::string> origin_problems(const Database& database) {
  std::vector<std::string> problems;
  const Provenance stated = database.provenance();
  if (to_hexadecimal(sha256(stated.bridge_text)) != database.bridge_sha256()) {
    problems.push_back(
        fmt::format("dataset '{}': does not have the SHA-256 that the file states", dataset::kBridgeText));
    return problems;
  }
  const BridgeDescription description = description_of(database);
  if (stated.bridge_name != description.name)
    problems.push_back(fmt::format("attribute '{}' is {}, expected {}, which the bridge text gives",
                                   attribute::kBridgeName, in_quotes(stated.bridge_name),
                                   in_quotes(description.name)));
  check_settings(stated.solver_settings, problems);
  if (!is_key_right(stated, description))
    problems.push_back(fmt::format(
        "attribute '{}': is not what bridge text, settings, compiler, flags and solver revision give",
        attribute::kResultsKey));
  return problems;
}

}  // namespace voussoir
