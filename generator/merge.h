#pragma once
/// @file Putting the parts of a database together that several machines have computed.

#include "generator/build.h"

namespace voussoir {

struct MergeRequest {
  std::vector<std::filesystem::path> parts;  ///< in any order
  std::filesystem::path output = "bridge.h5";
  int threads = 0;     ///< 0: one for each core
  bool force = false;  ///< build anew even if the file is up to date
  bool drop = false;   ///< BuildRequest::drop
};

/// A solver as a database states its settings.
using SolverOfSettings = std::function<SolverChoice(const std::string& settings)>;

/// Writes the database that one build of the whole would have written, to the last byte of its content. What
/// belongs to the whole (model error, sensitivities, search index) is computed here.
///
/// Throws InputError naming the files for parts that are none, of another bridge, version, settings,
/// variants, states or scenes, twice there or missing, and for parts that do not agree to the last bit about
/// the intact bridge, which all of them have solved. Failure if a scene's record is missing or damaged.
BuildSummary merge_databases(const MergeRequest& request, const SolverOfSettings& solver, Progress& progress);

}  // namespace voussoir
