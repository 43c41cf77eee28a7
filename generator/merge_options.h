#pragma once
/// @file The command line of merge-databases.

#include <optional>

#include "generator/merge.h"

namespace voussoir {

struct MergeOptions {
  MergeRequest request;
  bool quiet = false;
  bool json = false;
  std::optional<int> exit_code;  ///< set if the program is to end at once (--help, --version, bad usage)
};

/// Fills in the options; prints help, version or what is wrong with the command line itself.
void parse_merge_options(int argc, char** argv, MergeOptions& options);

}  // namespace voussoir
