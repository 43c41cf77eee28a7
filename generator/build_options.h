#pragma once
/// @file The command line of build-database.

#include <optional>

#include "generator/build.h"

namespace voussoir {

struct BuildOptions {
  std::optional<std::filesystem::path> bridge;  ///< nothing: the reference bridge
  BuildRequest request;                         ///< all but the bridge and its variants
  int variants = 0;                             ///< bridges to draw beside the nominal one
  std::uint64_t variant_seed = 1;
  SolverKind solver = SolverKind::quasi_static;
  DynamicSettings motion;                        ///< of scenes in motion
  std::optional<bool> collapse_fields;           ///< nothing: where motion follows the joints as they are
  std::optional<std::filesystem::path> drawing;  ///< only draw the bridge, into this file
  bool version = false;                          ///< only tell what would be built with what
  bool quiet = false;
  bool json = false;
  std::optional<int> exit_code;  ///< set if the program is to end at once (--help, --version, bad usage)
};

/// Fills in the options; prints help, version or what is wrong with the command line itself.
void parse_build_options(int argc, char** argv, BuildOptions& options);

/// Settles what depends on the bridge: whether fields of collapses are kept. Returns the solver.
SolverChoice settle_collapses(const Model& bridge, BuildOptions& options);

}  // namespace voussoir
