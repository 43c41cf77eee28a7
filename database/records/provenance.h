#pragma once
/// @file Where a database comes from: what was computed, with what.

#include <optional>
#include <string>
#include <vector>

#include "core/bridge_file/bridge_file.h"

namespace voussoir {

struct Provenance {
  std::string bridge_name;
  std::string bridge_text;  ///< the bridge file as it was given
  std::string
      solver_settings;  ///< "key = value" lines: everything beside the bridge that the results depend on
  std::string program_version;
  std::string compiler;
  std::string compile_flags;
  std::string solver_revision;  ///< hash of the source files that results depend on
  std::string results_key;      ///< equal keys: equal displacement fields for every scene
};

/// Provenance of what this program computes for a bridge file with these settings.
Provenance make_provenance(const BridgeFile& bridge, const std::string& solver_settings,
                           const std::string& results_key);

/// What differs between two provenances, each in a few words ("the bridge file", "solver settings: tolerance
/// = 1e-8, was 1e-10"); empty if nothing does.
std::vector<std::string> differences(const Provenance& now, const Provenance& before);

/// "0.1.0", compiler, flags and solver revision on lines of their own, as `--version` prints them.
std::string version_text(const std::string& program);

/// All of it in lines for people, the text of the bridge file last.
std::string describe(const Provenance& provenance);

/// The provenance as bytes (for the journal's header) and back; nothing if the bytes are no provenance.
std::string to_text(const Provenance& provenance);
std::optional<Provenance> parse_provenance(const std::string& text);

}  // namespace voussoir
