#pragma once
/// @file The command line of build-database.

#include <CLI/CLI.hpp>
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
  // Words of the command line, which finished() turns into settings.
  std::optional<std::string> scenes;  ///< nothing: all, and singles of variants
  std::vector<std::string> without;
};

/// Adds the options to the program.
void add_options(CLI::App& app, BuildOptions& options);

/// With what the command line's words stand for. Throws InputError for what does not go together.
BuildOptions finished(BuildOptions options);

/// Settles what depends on the bridge: whether fields of collapses are kept. Returns the solver.
SolverChoice settle_collapses(const Model& bridge, BuildOptions& options);

}  // namespace voussoir
