/// @file The hash that tells a database made by other source from one made by this.

#include "solver_revision.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <sstream>
#include <vector>

#include "database/format/sha256.h"
#include "tests/support/file_text.h"

namespace voussoir {
namespace {

const std::filesystem::path kSource = VOUSSOIR_SOURCE_DIR;

/// Every source file of core/ and of the folders in it but program/, by their names' order.
std::vector<std::string> core_sources() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kSource / "core")) {
    const auto extension = entry.path().extension();
    const std::string name = std::filesystem::relative(entry.path(), kSource).generic_string();
    if ((extension == ".cpp" || extension == ".h") && !name.starts_with("core/program/"))
      names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// The files of other folders that CMakeLists.txt names.
std::vector<std::string> other_sources() {
  std::vector<std::string> names;
  std::istringstream list(VOUSSOIR_OTHER_RESULT_SOURCES);
  for (std::string name; std::getline(list, name, ',');) names.push_back(name);
  return names;
}

/// 16 digits of the SHA-256 over lines of name and content's SHA-256.
std::string revision_of(const std::vector<std::string>& names) {
  std::string lines;
  for (const std::string& name : names)
    lines += name + " " + to_hexadecimal(sha256(test::text_of(kSource / name))) + "\n";
  return to_hexadecimal(sha256(lines)).substr(0, 16);
}

}  // namespace

TEST_CASE(
    "The solver's revision is the hash over every source of core/ but its programs' ends (computed anew)") {
  std::vector<std::string> sources = core_sources();
  CHECK(std::count_if(sources.begin(), sources.end(),
                      [](const std::string& name) { return name.starts_with("core/law/"); }) > 1);
  const std::vector<std::string> others = other_sources();
  for (const char* name : {"database/format/field_codec.cpp", "generator/scenes/composition.cpp",
                           "generator/uncertainty/error_fit.cpp"})
    CHECK(std::find(others.begin(), others.end(), name) != others.end());
  sources.insert(sources.end(), others.begin(), others.end());
  CHECK(revision_of(sources) == kSolverRevision);
}

}  // namespace voussoir
