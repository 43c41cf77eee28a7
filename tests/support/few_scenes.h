#pragma once
/// @file A small database that was solved for real, and what is said of it when it is damaged.

#include <algorithm>
#include <fstream>

#include "database/records/database.h"
#include "database/records/schema.h"
#include "generator/build.h"
#include "generator/verify/verify.h"
#include "tests/support/bridges.h"
#include "tests/support/file_text.h"
#include "tests/support/temporary_folder.h"

namespace voussoir::test {

/// A database of a few scenes of the small bridge, solved for real.
struct FewScenes {
  TemporaryFolder folder;
  std::filesystem::path path = folder / "few.h5";
  std::string bytes;

  FewScenes() {
    Progress quiet(Progress::Mode::quiet);
    BuildRequest request;
    request.bridge = small_file_with_sensors();
    request.output = path;
    request.scenes = "intact;4,1..3;0,5;4,1+4,2";
    request.threads = 1;
    build_database(request, quasi_static(), quiet);
    bytes = text_of(path);
  }

  VerifyReport verify_with(const std::string& changed, std::size_t recompute = 0) const {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << changed;
    VerifyRequest request{path};
    request.threads = 1;
    request.recompute = recompute;
    return verify_database(request);
  }
};

inline std::size_t place_of(const std::string& bytes, ByteView part) {
  const auto* begin = reinterpret_cast<const char*>(part.data());
  return static_cast<std::size_t>(std::search(bytes.begin(), bytes.end(), begin, begin + part.size()) -
                                  bytes.begin());
}

/// Datasets are views into one mapping of the file; the control table, whose content is found nowhere else,
/// tells where the mapping begins.
inline std::size_t place_of(const std::string& bytes, const Database& database, const char* path) {
  const ByteView anchor = database.dataset_bytes(dataset::kVertical);
  return place_of(bytes, anchor) +
         static_cast<std::size_t>(database.dataset_bytes(path).data() - anchor.data());
}

inline bool names(const VerifyReport& report, const std::string& what) {
  return std::any_of(report.problems.begin(), report.problems.end(),
                     [&](const std::string& problem) { return problem.find(what) != std::string::npos; });
}

}  // namespace voussoir::test
