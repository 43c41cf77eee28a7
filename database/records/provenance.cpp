#include "database/records/provenance.h"

#include <array>
#include <sstream>

#include "build_information.h"
#include "core/error.h"
#include "database/format/sha256.h"
#include "database/records/schema.h"
#include "solver_revision.h"

namespace voussoir {
namespace {

using Member = std::string Provenance::*;

constexpr std::array<Member, 8> kMembers = {&Provenance::bridge_name,     &Provenance::bridge_text,
                                            &Provenance::solver_settings, &Provenance::program_version,
                                            &Provenance::compiler,        &Provenance::compile_flags,
                                            &Provenance::solver_revision, &Provenance::results_key};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// Lines of the settings that changed, "tolerance = 1e-8 (was tolerance = 1e-10)".
void append_setting_changes(const std::string& now, const std::string& before,
                            std::vector<std::string>& changes) {
  const auto new_lines = lines_of(now);
  const auto old_lines = lines_of(before);
  if (new_lines.size() != old_lines.size()) {
    changes.push_back("the solver settings");
    return;
  }
  for (std::size_t i = 0; i < new_lines.size(); ++i)
    if (new_lines[i] != old_lines[i])
      changes.push_back(fmt::format("{} (was {})", new_lines[i], old_lines[i]));
}

}  // namespace

Provenance make_provenance(const BridgeFile& bridge, const std::string& solver_settings,
                           const std::string& results_key) {
  return {bridge.description.name,      bridge.text, solver_settings, kVersion, kCompiler, kCompileFlags,
          std::string(kSolverRevision), results_key};
}

std::vector<std::string> differences(const Provenance& now, const Provenance& before) {
  std::vector<std::string> changes;
  if (now.bridge_text != before.bridge_text) changes.push_back("the bridge file");
  append_setting_changes(now.solver_settings, before.solver_settings, changes);
  if (now.program_version != before.program_version)
    changes.push_back(fmt::format("version {} (was {})", now.program_version, before.program_version));
  if (now.compiler != before.compiler)
    changes.push_back(fmt::format("compiler {} (was {})", now.compiler, before.compiler));
  if (now.compile_flags != before.compile_flags)
    changes.push_back(fmt::format("compiler flags {} (was {})", now.compile_flags, before.compile_flags));
  if (now.solver_revision != before.solver_revision) changes.push_back("the solver's source");
  return changes;
}

std::string version_text(const std::string& program) {
  return fmt::format("{} {}\ncompiler: {}\nflags: {}\nsolver revision: {}", program, kVersion, kCompiler,
                     kCompileFlags, kSolverRevision);
}

std::string describe(const Provenance& provenance) {
  std::string text = fmt::format("schema version: {}\nresults key: {}\nsolver settings:\n", kSchemaVersion,
                                 provenance.results_key);
  for (const std::string& line : lines_of(provenance.solver_settings)) text += "  " + line + "\n";
  text += fmt::format("bridge: {}\nbridge SHA-256: {}\nbridge text:\n", provenance.bridge_name,
                      to_hexadecimal(sha256(provenance.bridge_text)));
  for (const std::string& line : lines_of(provenance.bridge_text)) text += "  " + line + "\n";
  return text;
}

std::string to_text(const Provenance& provenance) {
  std::string text;
  for (const Member member : kMembers)
    text += fmt::format("{}\n{}", (provenance.*member).size(), provenance.*member);
  return text;
}

std::optional<Provenance> parse_provenance(const std::string& text) {
  Provenance provenance;
  std::istringstream stream(text);
  for (const Member member : kMembers) {
    std::size_t size = 0;
    if (!(stream >> size) || stream.get() != '\n' || size > text.size()) return std::nullopt;
    (provenance.*member).resize(size);
    if (!stream.read((provenance.*member).data(), static_cast<std::streamsize>(size))) return std::nullopt;
  }
  return provenance;
}

}  // namespace voussoir
